// The clock of the tosses that are played: play, pause, the time's slider, and the speed.

import { element } from "./elements.js";
import { makeTimeline, proofText } from "./timeline.js";

const still = matchMedia("(prefers-reduced-motion: reduce)");

// `onTime` is called with the time, and with the time before where what is between is played.
export function makePlayer(onTime) {
  const [button, slider, clock, speed, marks] = ["play", "time", "clock", "speed", "marks"].map((id) => document.getElementById(id));
  let line = makeTimeline([]), end = 0, time = 0, last = null, playing = false;

  function tick(now) {
    if (!playing) return;
    const before = time;
    time = Math.min(time + (Math.max(now - (last ?? now), 0) / 1000) * Number(speed.value), end);
    last = now;
    if (time >= end) stop();
    told(playing ? before : null);
    if (playing) requestAnimationFrame(tick);
  }

  function told(before = null) {
    slider.value = String(line.placeOf(time));
    clock.textContent = `${time.toFixed(3)} s`;
    slider.setAttribute("aria-valuetext", clock.textContent);
    button.textContent = playing ? "Pause" : "Play";
    onTime(time, before);
  }

  const stop = () => ([playing, last] = [false, null]);

  function play() {
    if (time >= end) time = 0;
    [playing, last] = [true, null];
    requestAnimationFrame(tick);
  }

  button.addEventListener("click", () => {
    playing ? stop() : play();
    told();
  });
  slider.addEventListener("input", () => seek(line.timeAt(Number(slider.value))));

  function seek(wanted) {
    stop();
    time = Math.min(Math.max(wanted, 0), end);
    told();
  }

  return {
    // Other tosses; where they are `fresh` from the start, or at a moment where motion is unwanted.
    load(tosses, fresh, moment) {
      line = makeTimeline(tosses);
      end = line.isEmpty ? 0 : line.end;
      slider.max = String(end);
      slider.disabled = button.disabled = end === 0;
      showMarks(marks, line);
      if (fresh) {
        time = still.matches ? (moment ?? end) : 0;
        if (!still.matches && end > 0) play();
      }
      told();
    },
    seek, redraw: () => onTime(time, null),
  };
}

// Below the slider: where its scale changes, and from which moments on the coins can't turn over.
function showMarks(box, { end, pivot, bend, proofs, placeOf }) {
  box.hidden = pivot === end && !proofs.length;
  const mark = (kind, place, text) => {
    const made = element("span", kind, text);
    made.style.setProperty("--place", String(place / end));
    return made;
  };
  box.replaceChildren(
    ...(pivot < end ? [mark("squeezed", bend, "")] : []),
    ...proofs.map(({ engine, time }) => mark(`proof ${engine}`, placeOf(time), "")),
    ...proofs.slice(0, 1).map(({ time }) => mark("said", placeOf(time), proofText(proofs))),
  );
  box.title = pivot < end ? `The shaded part, from ${pivot.toFixed(3)} s on, has a scale of its own: the wobble.` : "";
}
