// The coin that is thrown by hand, and the challenge: three heads in a row.

import { handOf, kellersCurve, longestRow, ROW, turnsOf } from "./challenge.js";
import { shape } from "./elements.js";
import { changed } from "./engine.js";
import { makeFlick } from "./flick.js";
import { counted } from "./outcome.js";

const SPEED = "release.velocity.z", SPIN = "release.angular_velocity.eta";
const MOST = 0.3; // the largest scatter of a hand in the lab
const HEADS = "#f5ab1f", TAILS = "#0d5ca8";
const WIDE = 320, HIGH = 120, LEFT = 44, FOOT = 26, TURNS = 1;

// `parts` are elements. `lab` has change(more), isCaught() and state().
export function makeThrows({ handle, box, told, curve, again }, lab) {
  let throws = [], waiting = null;

  makeFlick(handle, (thrown) => {
    const { scenario } = lab.state();
    waiting = thrown;
    lab.change({ scenario: changed(scenario, { [SPEED]: thrown.speed, [SPIN]: thrown.spin }), before: null });
  });
  again.addEventListener("click", () => ((throws = []), lab.change({ hand: null })));

  // The outcome of the toss that was thrown last.
  function landed(outcome) {
    if (!waiting) return;
    if (lab.isCaught()) throws = [...throws, { ...waiting, outcome }];
    waiting = null;
    show();
    if (longestRow(throws) < ROW || throws.at(-1)?.outcome !== "heads") return;
    const { speed, spin, scatter } = handOf(throws);
    lab.change({ scenario: changed(lab.state().scenario, { [SPEED]: speed, [SPIN]: spin }), hand: Math.min(scatter, MOST) });
  }

  function show() {
    box.hidden = !(lab.isCaught() && throws.length);
    if (box.hidden) return;
    const row = longestRow(throws), hand = handOf(throws), heads = throws.filter(({ outcome }) => outcome === "heads").length;
    const faces = throws.map(({ outcome }) => outcome[0].toUpperCase()).join(" ");
    const goal = row >= ROW ? `Three heads in a row, after ${counted(throws.length, "throw")}!` : "The challenge: land three heads in a row.";
    const score = hand ? ` ${heads} of ${throws.length} are heads. Your turns scatter by ${hand.turns.toFixed(2)}: such a hand lands heads in at most ${(100 * kellersCurve(hand.turns)).toFixed(0)} % (Keller's curve).` : "";
    told.textContent = `${goal} ${faces}: ${turnsOf(throws.at(-1)).toFixed(2)} turns.${score}`;
    draw(hand, heads / throws.length);
  }

  // Keller's curve, the most heads that a scatter of the turns allows, and this hand on it.
  function draw(hand, share) {
    const x = (turns) => LEFT + (Math.min(turns, TURNS) / TURNS) * (WIDE - LEFT - 10), y = (part) => 8 + (1 - part) * (HIGH - FOOT - 8);
    const points = Array.from({ length: 101 }, (_, i) => (i * TURNS) / 100).map((turns) => `${x(turns).toFixed(1)},${y(kellersCurve(turns)).toFixed(1)}`);
    const text = (words, at, place, anchor) => shape("text", { x: at, y: place, "text-anchor": anchor }, words);
    const texts = [text("100 %", LEFT - 4, y(1) + 4, "end"), text("50 %", LEFT - 4, y(0.5) + 4, "end"),
      text("scatter of the turns", (LEFT + WIDE) / 2, HIGH - 2, "middle"), text("0", LEFT, HIGH - 12, "middle"), text(String(TURNS), x(TURNS), HIGH - 12, "middle")];
    const axis = shape("path", { d: `M${LEFT} 4V${y(0)}H${WIDE - 10}M${LEFT} ${y(0.5)}H${WIDE - 10}`, class: "axis" });
    curve.replaceChildren(axis, shape("polyline", { points: points.join(" "), class: "line" }), ...texts,
      ...(hand ? [shape("circle", { cx: x(hand.turns), cy: y(share), r: 5 })] : []));
  }

  return {
    landed, show,
    isInTheAir: () => waiting !== null,
    // Where the throws lie on a map of spin and speed.
    marks: () => (lab.isCaught() ? throws.map(({ spin, speed, outcome }) => ({ values: { [SPIN]: spin, [SPEED]: speed }, color: outcome === "heads" ? HEADS : TAILS })) : []),
  };
}
