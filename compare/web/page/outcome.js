// How a toss ended, as a line of text.

import { nameOf } from "./motion.js";

export const counted = (number, thing) => `${number} ${thing}${number === 1 ? "" : "s"}`;

// Returns the line of a toss, which may be one that failed, or of which only the engine is known yet.
export function outcomeLine(toss) {
  const line = document.createElement("p"), name = document.createElement("b");
  name.className = toss.engine;
  name.textContent = `${nameOf(toss)}: `;
  const text = toss.problem ?? (toss.path
    ? [`${toss.outcome} after ${counted(toss.count, "impact")} in ${toss.end_time.toFixed(4)} s. ${toss.ending}`, ...toss.notes].join(" ")
    : "tossing …");
  line.append(name, text);
  return line;
}
