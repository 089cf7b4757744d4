// The report's coins in 3D, and its plots.

import { energyOf, heightOf, placeOf, spinOf, tiltsOf } from "./motion.js";
import { makePlot, makeSpan } from "./plot.js";
import { makePresentation } from "./present.js";
import { makeStage } from "./stage.js";

const { tosses, apart, parted, rounding, ...data } = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const span = makeSpan(tosses);

// Of one other engine two lines in colours of their own; those of several have the colours of their engines.
function apartLines({ engine, label, time, distance, angle }) {
  const [kinds, of] = apart.length > 1 ? [[engine, `${engine} second`], `, ${label}`] : [["green", "purple"], ""];
  return [
    { name: `distance / r${of}`, kind: kinds[0], time, values: distance },
    { name: `angle [rad]${of}`, kind: kinds[1], time, values: angle },
  ];
}

const apartPlot = {
  title: "difference of the engines", log: true, range: [rounding, 1e3], marks: tosses[0].times,
  levels: [{ value: parted, text: `${parted} r` }], lines: apart.flatMap(apartLines),
};

const plots = {
  height: heightOf(tosses), place: placeOf(tosses), tilt: tiltsOf(tosses), spin: spinOf(tosses), energy: energyOf(tosses),
  ...(apart.length && { apart: apartPlot }),
};
// Bars of several engines have their colours, and one name, over the last.
const bars = data.bars.map(({ time, engine }, i) => apart.length > 1
  ? { time, kind: engine, text: i === data.bars.length - 1 ? "horizons" : "" }
  : { time, text: "horizon" });
for (const [name, about] of Object.entries(plots)) makePlot(byId(`plot-${name}`), { ...about, bars }, span);

const labels = Object.fromEntries(tosses.map(({ engine, label }) => [engine, label]));
const stage = makeStage(byId("played"), { without: "The plots work without it.", labels, onTime: span.play });
stage.show(tosses, tosses.map((toss) => toss.outcome), true);
// Where motion is unwanted the coins stand as they are released: the end is beyond the horizon.
if (matchMedia("(prefers-reduced-motion: reduce)").matches) stage.seek(0);
const faces = document.querySelector(".faces"), bar = faces?.querySelector(".bars:last-of-type");
if (bar) faces.scrollTop = Math.max(0, bar.offsetTop + bar.offsetHeight - faces.clientHeight);
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
