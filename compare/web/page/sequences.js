// The faces up at the touches of both tosses, each up to its horizon, and those of the toss before.

import { element } from "./elements.js";
import { nameOf } from "./motion.js";

const ROUNDED = 1e-6; // times of touches have seven digits
const MOST = 18; // faces that are shown of a toss, but more where its horizon lies behind them
const CELL = 27, GAP = 7; // width of a face, and between two, as in shared.css [px]

export function commonPrefix(a, b) {
  let n = 0;
  while (n < Math.min(a.length, b.length) && a[n] === b[n]) n++;
  return n;
}

export function showSequences(box, tosses, before, after) {
  const rows = tosses.filter((toss) => toss?.path).map((toss) => row(nameOf(toss), toss.engine, toss, after));
  if (before) rows.push(row("before", "", before, null));
  const longest = Math.max(0, ...tosses.filter((toss) => toss?.path).map((toss) => facesOf(toss).length));
  const numbers = element("div", "row numbers");
  numbers.setAttribute("aria-hidden", "true");
  numbers.append(element("b"), ...Array.from({ length: longest }, (_, i) => element("span", "", String(i + 1))));
  box.replaceChildren(...rows, ...(longest ? [numbers] : []));
  wrap(box);
  watched.observe(box);
}

// The rows are cut where the box ends, all at the same touch, and go on below each other.
function wrap(box) {
  const rows = [...box.querySelectorAll(".row")], [name, first] = rows[0]?.children ?? [];
  if (!first || !box.clientWidth) return;
  const wide = Math.max(Math.floor((box.clientWidth - name.offsetWidth - GAP) / (CELL + GAP)), 1);
  rows.forEach((row, i) => [...row.children].forEach((cell, k) => {
    const at = Math.max(k - 1, 0);
    cell.style.gridRow = String(Math.floor(at / wide) * rows.length + i + 1);
    cell.style.gridColumn = k ? `${(at % wide) + 2} / span ${cell.tagName === "EM" ? Math.min(5, wide - (at % wide)) : 1}` : "1";
  }));
}

const watched = new ResizeObserver((seen) => seen.forEach(({ target }) => wrap(target)));

const facesOf = ({ sequence, trusted, count }) => sequence.slice(0, Math.max(MOST, trusted < count ? trusted + 1 : 0));

function row(label, kind, toss, after) {
  const found = element("div", "row"), { trusted, count } = toss, sequence = facesOf(toss);
  const more = count > sequence.length ? `… ${count} faces` : "";
  found.setAttribute("role", "img");
  found.setAttribute("aria-label", `${label}: ${[...sequence, ...(more && [more])].join(" ")}; horizon of trust after touch ${Math.min(trusted, count)} of ${count}`);
  found.append(element("b", `${kind}${trusted === 0 && count ? " horizon" : ""}`, label));
  [...sequence].forEach((face, i) => {
    // The bar stands in the gap, so that columns stay below each other.
    const kinds = [face, i >= trusted && "beyond", i === trusted - 1 && trusted < count && "horizon", i === after && "mapped"];
    const cell = element("span", kinds.filter(Boolean).join(" "), face);
    cell.dataset.touch = String(i);
    if (kind) cell.dataset.engine = toss.engine;
    found.append(cell);
  });
  if (more) found.append(element("em", "", more));
  return found;
}

// Marks the last touch before a time.
export function markTouch(box, tosses, time) {
  for (const marked of box.querySelectorAll(".now")) marked.classList.remove("now");
  for (const toss of tosses) {
    if (!toss?.path) continue;
    const touched = toss.times.filter((each) => each <= time * (1 + ROUNDED)).length;
    box.querySelector(`[data-engine="${toss.engine}"][data-touch="${touched - 1}"]`)?.classList.add("now");
  }
}

// What the horizons say, in sentences.
export function horizonText(tosses, before, after) {
  const [a, b] = tosses.map((toss) => (toss?.path ? toss : null)), parts = [];
  const own = (toss) => (toss.trusted >= toss.count ? `all ${toss.count}` : `the first ${toss.trusted}`);
  if (a || b) {
    const horizons = [a, b].filter(Boolean).map((toss) => `${nameOf(toss)}: ${own(toss)}`).join(", ");
    parts.push([a, b].every((toss) => !toss || toss.trusted >= toss.count)
      ? "Errors of the computation, which each touch amplifies, can't have changed any of these faces."
      : `The bar is the horizon of trust (${horizons}): errors of the computation, which each touch amplifies, can't have changed a face before it, and could have changed one after it.`);
  }
  if (a && b) {
    const shared = commonPrefix(a.sequence, b.sequence);
    const all = shared === Math.max(a.sequence.length, b.sequence.length);
    parts.push(all ? "Both sequences are the same." : sharedText(shared, "The two tosses"));
  }
  if (before && a) {
    const shared = commonPrefix(before.sequence, a.sequence);
    const same = shared === Math.max(before.sequence.length, a.sequence.length);
    parts.push(same ? "The toss before has the same sequence." : sharedText(shared, "This toss and the one before"));
  }
  if (after !== null) parts.push(`The map shows touch ${after + 1}, framed.`);
  return parts.join(" ");
}

const sharedText = (shared, both) => (shared ? `${both} show the same faces up to touch ${shared}.` : `${both} differ from the first touch on.`);
