// How a toss ended, as a line of text.

import { element } from "./elements.js";
import { nameOf } from "./motion.js";

export const counted = (number, thing, things = `${thing}s`) => `${number.toLocaleString("en")} ${number === 1 ? thing : things}`;

// Returns the line of a toss, which may be one that failed, or of which only the engine is known yet.
export function outcomeLine(toss) {
  const line = element("p"), name = element("b", toss.engine, `${nameOf(toss)}: `);
  const text = toss.problem ?? (toss.path
    ? [`${toss.outcome} after ${counted(toss.count, "impact")} in ${toss.end_time.toFixed(4)} s. ${toss.ending}`, ...toss.notes].join(" ")
    : "tossing …");
  line.append(name, text);
  return line;
}
