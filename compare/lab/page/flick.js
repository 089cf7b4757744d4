// A coin that is thrown by hand: drag it and flick it, or hold a key down, for its speed and its spin.

const LAST = 120; // milliseconds of the drag that count
const TAP = 8; // pixels: less is a click
const HOLD = 1200; // milliseconds in which a key that is held reaches the strongest throw
// The least and the most [m/s], [rad/s]: the weakest throw turns once before it is caught.
export const SPEEDS = [1, 3], SPINS = [32, 100];

const within = (value, [low, high]) => Math.min(Math.max(value, low), high);

// Of a flick in pixels per millisecond, to the right and up: the way up gives the speed, all of it the spin.
export function thrown(right, up) {
  return { speed: within(1.2 * up, SPEEDS), spin: within(18 * Math.hypot(right, up) + 14 * Math.abs(right), SPINS) };
}

const strength = (span) => Math.min(Math.max(span / HOLD, 0), 1);
const pushed = (span) => 0.8 + 1.7 * strength(span);

// Calls `onThrow` with { speed, spin }: a click is the throw of a key that is held as long.
export function makeFlick(handle, onThrow) {
  let trace = null, held = null;

  handle.addEventListener("pointerdown", (event) => {
    trace = [event];
    handle.setPointerCapture(event.pointerId);
    handle.classList.add("held");
  });
  handle.addEventListener("pointermove", (event) => {
    if (!trace) return;
    trace.push(event);
    handle.style.transform = `translate(${event.clientX - trace[0].clientX}px, ${event.clientY - trace[0].clientY}px)`;
  });
  const let_go = (event) => {
    const path = trace ?? [], last = path.filter((each) => event.timeStamp - each.timeStamp <= LAST), first = last[0] ?? path.at(-1);
    drop();
    if (!first || event.type === "pointercancel") return;
    const far = Math.hypot(event.clientX - path[0].clientX, event.clientY - path[0].clientY), took = Math.max(event.timeStamp - first.timeStamp, 8);
    if (far < TAP) onThrow(thrown(0, pushed(event.timeStamp - path[0].timeStamp)));
    else onThrow(thrown((event.clientX - first.clientX) / took, (first.clientY - event.clientY) / took));
  };
  for (const end of ["pointerup", "pointercancel"]) handle.addEventListener(end, let_go);

  function drop() {
    trace = held = null;
    handle.removeAttribute("style");
    handle.classList.remove("held");
  }

  handle.addEventListener("keydown", (event) => {
    if (event.key === "Escape") drop();
    if (event.key !== " " && event.key !== "Enter") return;
    event.preventDefault();
    if (event.repeat) return handle.style.setProperty("--strength", String(strength(event.timeStamp - held)));
    held = event.timeStamp;
    handle.classList.add("held");
  });
  handle.addEventListener("keyup", (event) => {
    if (held === null || (event.key !== " " && event.key !== "Enter")) return;
    const span = event.timeStamp - held;
    drop();
    onThrow(thrown(0, pushed(span)));
  });
  handle.addEventListener("blur", drop);
}
