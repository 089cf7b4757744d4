// The explorer's page: the map, the pixel that is chosen, and its toss by both engines.

import { anywhere, grid, isStatic, loadMap, tile, toss } from "./source.js";
import { indexOf, shown, valueAt } from "./axes.js";
import { element, legendOf } from "./elements.js";
import { makeMap } from "./map.js";
import { clamp } from "./map_view.js";
import { LABELS } from "./motion.js";
import { counted, outcomeLine } from "./outcome.js";
import { makeStage } from "./stage.js";
import { horizonText, markTouch, showSequences } from "./sequences.js";
import { showEnergy } from "./energy.js";

const ENGINES = ["analytic", "mujoco"];
const KEPT = 40; // pixels whose tosses are kept
const byId = (id) => document.getElementById(id);

let map, view, stage, moveEnergy = () => {};
let tosses = [null, null], chosen = null, before = null, wanted = null, busy = false;
const kept = new Map();

async function begin() {
  map = await loadMap();
  map.impacts = new Int32Array(bytes(map.arrays.impacts));
  map.margins = map.arrays.margin ? new Float32Array(bytes(map.arrays.margin)) : null;
  map.trusted = map.arrays.trusted_impacts ? new Int32Array(bytes(map.arrays.trusted_impacts)) : null;
  describe();
  stage = makeStage(byId("played"), {
    without: "The map, the sequences and the energies work without it.",
    onTime(time) {
      markTouch(byId("sequences"), tosses, time);
      moveEnergy(time);
    },
  });
  byId("map").style.setProperty("--shape", String(clamp(map.axes.x.count / map.axes.y.count, 0.6, 2)));
  const whole = map.axes.x.field !== "ending.max_impacts" && map.axes.y.field !== "ending.max_impacts";
  view = makeMap({
    canvas: byId("map"), map, grid, anywhere, tile: isStatic || !whole ? null : tile,
    onHover: (place) => (byId("readout").textContent = placeText(place)),
    onChoose: choose,
    onNearest: (text) => (byId("boundary").textContent = text),
    onProblem: (message) => (byId("readout").textContent = message),
  });
  byId("zoom-in").addEventListener("click", () => view.zoom(0.5));
  byId("zoom-out").addEventListener("click", () => view.zoom(2));
  byId("whole").addEventListener("click", () => view.showWhole());
  if (!fromAddress()) view.chooseMiddle();
  document.body.dataset.ready = "true";
}

function describe() {
  byId("name").textContent = map.title;
  document.title = `${map.title}: cointoss explore`;
  const parts = [
    `${map.name}: ${map.axes.x.count} by ${map.axes.y.count} tosses by the ${LABELS[map.engine]} engine: ` +
      (map.after === null ? "the final outcome." : `the face at touch ${map.after + 1}, or the final face of a toss that ended before.`)];
  if (map.stride > 1) parts.push(`One pixel of every ${map.stride} along each axis is shown.`);
  if (map.tossed < 1) parts.push(`The map is not finished: ${(100 * map.tossed).toFixed(1)} % is tossed${isStatic ? "" : "; reload to see more"}.`);
  if (isStatic) parts.push(anywhere ? "Any pixel can be tossed by the analytic engine; MuJoCo has tossed those with a dot, and a click near a dot takes it." : "Both engines have tossed the pixels with a dot; a click takes the nearest.");
  byId("about").textContent = parts.join(" ");
  byId("fields").textContent = `Across: ${fieldText(map.axes.x)}. Up: ${fieldText(map.axes.y)}.`;
  const present = new Set(Int8Array.from(bytesOf(map.arrays.outcome)));
  const entries = Object.entries(map.outcomes).filter(([code]) => present.has(Number(code))).map(([, one]) => [one.label, one.color]);
  if (present.has(-1)) entries.push(["not tossed", "var(--untossed)"]);
  if (map.arrays.untrusted) entries.push(["untrusted: the engine's own errors may have decided it", "repeating-linear-gradient(135deg, #fff 0 2px, var(--soft) 2px 6px)"]);
  byId("legend").replaceChildren(...legendOf(entries));
}

const fieldText = (axis) => `${axis.word} (${axis.field})`;
const valueText = (axis, value, step) => `${axis.word} = ${shown(value, step)} ${axis.unit}`.trim().replaceAll(" ", "\u00a0");

function releaseText(place) {
  const { x, y } = map.axes, step = (axis) => ((axis.stop - axis.start) / (axis.count - 1)) * Math.min(place.step, 1);
  return `${valueText(x, place.x, step(x))}, ${valueText(y, place.y, step(y))}`;
}

function placeText(place) {
  const parts = [releaseText(place)];
  if (place.code !== null) parts.push(place.code < 0 ? "not tossed" : `${map.after === null ? "" : `face at touch ${map.after + 1}: `}${map.outcomes[place.code].label}`);
  if (place.index !== null && map.impacts[place.index] >= 0) parts.push(`${counted(map.impacts[place.index], "impact")}${trustText(place)}`);
  return `${parts.join("; ")}${marginText(place)}`;
}

const trustText = ({ index }) => (map.trusted && map.trusted[index] >= 0 ? `, ${map.trusted[index]} of them trusted` : "");

function marginText(place) {
  if (!map.margins || place.index === null || Number.isNaN(map.margins[place.index])) return "";
  const margin = map.margins[place.index], { along, unit } = map.margin;
  if (!Number.isFinite(margin)) return `; no change of ${along} up to 1 SI unit was found to change it`;
  return `; margin along ${along} ${margin > 0 ? "+" : "−"}${Number(Math.abs(margin).toPrecision(3))} ${unit}`;
}

function choose(place) {
  byId("readout").textContent = placeText(place);
  if (chosen && place.x === chosen.x && place.y === chosen.y) return;
  before = tosses[0]?.path ? tosses[0] : null;
  chosen = place;
  // A page in the frame of a notebook has no address of its own.
  if (location.protocol !== "about:") history.replaceState(null, "", `#x=${place.x}&y=${place.y}`);
  tellFaces([]);
  byId("release").textContent = `${releaseText(place)}${marginText(place)}`;
  stage.clear();
  byId("outcome").textContent = "Tossing …";
  wanted = place;
  if (!busy) answer();
}

// What the map shows of the toss, and how the toss ended, which may be another face.
function tellFaces(there) {
  const color = chosen.code === null || chosen.code < 0 ? null : map.outcomes[chosen.code].label, same = there.every((one) => one.outcome === there[0].outcome);
  const ends = same ? there.slice(0, 1).map((one) => one.outcome) : there.map((one) => `${one.outcome} (${LABELS[one.engine]})`);
  const rows = [
    ...(color && map.after !== null ? [[`Face at touch ${map.after + 1}, the map's colour:`, color]] : []),
    [map.after === null && color ? "Final face, the map's colour:" : "Final face:", ends.join(", ") || "…"]];
  byId("faces").replaceChildren(...rows.map((row) => {
    const made = element("div");
    made.append(element("dt", "", row[0]), element("dd", "", row[1]));
    return made;
  }));
}

// Tosses the pixel that was chosen last; those between are passed over.
async function answer() {
  busy = true;
  while (wanted) {
    const place = wanted, key = `${place.x},${place.y}`, found = kept.get(key) ?? [null, null];
    wanted = null;
    let fresh = true;
    for (const [i, engine] of ENGINES.entries()) {
      if (wanted) break;
      try {
        found[i] ??= await toss(engine, place);
      } catch (error) {
        found[i] = { engine, problem: error.message, passing: true };
      }
      if (!wanted) show(found, fresh);
      fresh = false;
    }
    if (found.every((one) => one && !one.passing)) kept.set(key, found);
    if (kept.size > KEPT) kept.delete(kept.keys().next().value);
  }
  busy = false;
}

function show(found, fresh) {
  tosses = [...found];
  const there = tosses.filter((one) => one?.path);
  for (const part of document.querySelectorAll(".of-toss")) part.hidden = there.length === 0;
  showSequences(byId("sequences"), tosses, before, map.after);
  byId("horizon").textContent = horizonText(tosses, before, map.after);
  moveEnergy = showEnergy(byId("energy"), tosses);
  byId("outcome").replaceChildren(...ENGINES.map((engine, i) => outcomeLine(tosses[i] ?? { engine })));
  tellFaces(there);
  stage.show(tosses, tosses.map((one) => (one?.outcome ? `${map.after === null ? "" : "final: "}${one.outcome}` : one ? "no toss" : "…")), fresh);
}

// Chooses the pixel that the address names after its #, and returns whether it names one.
function fromAddress() {
  const given = new URLSearchParams(location.hash.slice(1)), x = Number(given.get("x") ?? NaN), y = Number(given.get("y") ?? NaN);
  if (!Number.isFinite(x) || !Number.isFinite(y)) return false;
  const near = (axis, value) => {
    const at = clamp(indexOf(axis, value), 0, axis.count - 1), whole = Math.round(at);
    return valueAt(axis, whole) === value || Math.abs(at - whole) < 1e-6 ? whole : at;
  };
  view.choose(near(map.axes.x, x), near(map.axes.y, y), true);
  return true;
}

function bytesOf(text) {
  return Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
}

const bytes = (text) => bytesOf(text).buffer;

begin().catch((error) => (byId("about").textContent = error.message));
