// The report's coins in 3D, and its plots.

import { energyOf, heightOf, placeOf, spinOf, tiltsOf } from "./motion.js";
import { makePlot, makeSpan } from "./plot.js";
import { makePresentation } from "./present.js";
import { makeStage } from "./stage.js";

const { tosses, apart, horizon } = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const span = makeSpan(Math.max(...tosses.map((toss) => toss.end_time)));

function apartOf({ time, distance, angle, parted, rounding }) {
  return {
    title: "difference of the engines", log: true, range: [rounding, 1e3], marks: tosses[0].times,
    levels: [{ value: parted, text: `${parted} r` }],
    lines: [
      { name: "distance / r", kind: "green", time, values: distance },
      { name: "angle [rad]", kind: "purple", time, values: angle },
    ],
  };
}

const plots = {
  height: heightOf(tosses), place: placeOf(tosses), tilt: tiltsOf(tosses), spin: spinOf(tosses), energy: energyOf(tosses),
  ...(apart && { apart: apartOf(apart) }),
};
const bars = horizon === null ? [] : [{ time: horizon, text: "horizon" }];
for (const [name, about] of Object.entries(plots)) makePlot(byId(`plot-${name}`), { ...about, bars }, span);

const stage = makeStage(byId("played"), { without: "The plots work without it.", onTime: span.play });
stage.show(tosses, tosses.map((toss) => toss.outcome), true);
span.pick = (time) => {
  byId("played").scrollIntoView({ block: "nearest" });
  stage.seek(time);
};

makePresentation(byId("present"), byId("play"));
byId("present").hidden = false;
// The film is on the page once: it is its own download.
if (byId("save")) byId("save").href = byId("film").src;

byId("zoom-in").addEventListener("click", () => span.zoom(0.5));
byId("zoom-out").addEventListener("click", () => span.zoom(2));
byId("whole").addEventListener("click", () => span.show(0, span.end));
document.body.dataset.ready = "true";
