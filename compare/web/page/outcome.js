// How a toss ended, as a line of text.

import { element } from "./elements.js";
import { nameOf } from "./motion.js";

export const counted = (number, thing, things = `${thing}s`) => `${number.toLocaleString("en")} ${number === 1 ? thing : things}`;

export const outcomeText = ({ outcome, count, end_time, ending }) =>
  `${outcome}${count ? ` after ${counted(count, "impact")} in` : " after"} ${end_time.toFixed(4)} s. ${ending}`;

// Returns the line of a toss, which may be one that failed, or of which only the engine is known yet.
export function outcomeLine(toss) {
  const line = element("p");
  line.append(element("b", toss.engine, `${nameOf(toss)}: `), toss.problem ?? (toss.path ? [outcomeText(toss), ...toss.notes].join(" ") : "tossing …"));
  return line;
}
