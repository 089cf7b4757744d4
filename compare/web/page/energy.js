// Energy over time of both tosses, on a logarithmic scale, with the least energy to turn over.

import { energyOf } from "./motion.js";
import { makePlot, makeSpan } from "./plot.js";

// Returns what is to be called with the time that is played.
export function showEnergy(box, tosses, height = 230) {
  const there = tosses.filter((toss) => toss?.path);
  box.replaceChildren();
  if (!there.length) return () => {};
  const span = makeSpan(there);
  makePlot(box, { ...energyOf(there), height }, span);
  return span.play;
}
