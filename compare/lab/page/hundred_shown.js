// The panel of the hundred coins: their scene, the strip of their faces, and the count of heads.

import { makeCrowd } from "./crowd.js";
import { COINS, ends, faceAt, headsByTouch, isHeads, partingTouch, spread, tossHundred } from "./hundred.js";
import { counted } from "./outcome.js";
import { placeIn } from "./sampled.js";

const MOST = 24; // touches that are shown
const FACES = { H: "#f5ab1f", T: "#0d5ca8" };

// `parts` are elements; `workers` toss, and `told` is called with a problem.
export function makeHundred(parts, workers, told) {
  let crowd = null, tosses = null, tossed = "";

  // Tosses all coins of a hair, or shows none where it is null.
  async function toss(scenario, hair) {
    const key = JSON.stringify([scenario, hair]);
    if (key === tossed) return;
    const found = hair === null ? null : await tossHundred((each, samples) => workers.toss(each, samples), scenario, hair);
    tossed = key;
    tosses = found;
    parts.box.hidden = tosses === null;
    if (!tosses) return;
    try {
      crowd ??= makeCrowd(parts.scene);
    } catch {
      parts.scene.parentElement.hidden = true;
      told("The hundred coins are not shown: this browser has no WebGL. Their faces are.");
    }
    crowd?.show(tosses);
    drawStrip(parts.strip, tosses);
    parts.parting.textContent = partingText(scenario, hair);
  }

  function partingText(scenario, hair) {
    const at = partingTouch(tosses), { heads, tails } = ends(tosses), different = new Set(spread(scenario, hair)).size;
    const when = at === null ? "All show the same face at every touch." : at === 1 ? "They part at the first touch." : `All show the same face up to touch ${at - 1}, and part at touch ${at}.`;
    const doubles = different < COINS ? ` Doubles end here: the hundred have only ${different} different numbers.` : "";
    return `A row for each coin, a column for each touch. ${when} In the end: ${heads} heads, ${tails} tails; a coin lies once its face is certain.${doubles}`;
  }

  function draw(time) {
    if (!tosses) return;
    crowd?.draw(time);
    const heads = tosses.filter((one) => isHeads(one, placeIn(one.path.time, time))).length;
    parts.heads.textContent = `Heads up now: ${heads} of ${counted(COINS, "coin")}`;
    parts.up.style.width = `${(100 * heads) / COINS}%`;
  }

  return {
    toss, draw,
    isShown: () => tosses !== null,
    // The toss whose path is the longest: the clock goes as far.
    longest: () => tosses && tosses.reduce((one, other) => (other.path.time.at(-1) > one.path.time.at(-1) ? other : one)),
  };
}

// The faces of the coins, a row for each coin and a column for each touch.
function drawStrip(canvas, tosses) {
  const heads = headsByTouch(tosses).slice(0, MOST), pen = canvas.getContext("2d");
  Object.assign(canvas, { width: Math.max(heads.length, 1), height: tosses.length });
  tosses.forEach((toss, i) => heads.forEach((_, k) => {
    pen.fillStyle = FACES[faceAt(toss, k + 1)] ?? "#888";
    pen.fillRect(k, i, 1, 1);
  }));
  canvas.setAttribute("aria-label", `Heads among ${tosses.length} coins at each touch: ${heads.join(", ")}`);
}
