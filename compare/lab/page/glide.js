// The way from one state of the lab to another, slow enough to be followed.

const LONG = 1600; // [ms]
const still = matchMedia("(prefers-reduced-motion: reduce)");

// A state between two, `part` of the way; null where they differ in more than numbers. `fields` has their defaults.
export function between(from, to, part, fields) {
  if (["x", "y"].some((name) => from[name].field !== to[name].field) || from.after !== to.after) return null;
  const named = [...new Set([...Object.keys(from.scenario), ...Object.keys(to.scenario)])];
  const mixed = (a, b) => a + part * (b - a), scenario = {};
  for (const field of named) {
    const [a, b] = [from, to].map((state) => state.scenario[field] ?? fields[field].default);
    if (a !== b && (typeof a !== "number" || typeof b !== "number")) return null;
    scenario[field] = a === b ? a : mixed(a, b);
  }
  const axis = (name) => ({ ...to[name], from: mixed(from[name].from, to[name].from), to: mixed(from[name].to, to[name].to) });
  return { ...to, scenario, x: axis("x"), y: axis("y") };
}

// Calls `show` with states on the way, and at the end with the last one; returns what stops it.
export function glide(from, to, fields, show) {
  let begun = null, frame = 0;
  const step = (now) => {
    begun ??= now;
    const gone = (now - begun) / LONG, part = gone * gone * (3 - 2 * gone);
    const state = gone < 1 ? between(from, to, part, fields) : null;
    show(state ?? to, state === null);
    frame = state ? requestAnimationFrame(step) : 0;
  };
  if (still.matches) show(to, true);
  else frame = requestAnimationFrame(step);
  return () => cancelAnimationFrame(frame);
}
