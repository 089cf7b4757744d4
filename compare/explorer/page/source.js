// Where the map and its tosses come from: the server, or the page itself where it is one file.

import { changed, unpacked } from "./engine.js";
import { startWorkers } from "./workers.js";

const SIDE = 32; // of a tile, in its own pixels

const held = document.getElementById("data");
const data = held && JSON.parse(held.textContent);

async function asked(target) {
  let answer;
  try {
    answer = await fetch(target);
  } catch {
    throw new Error("cointoss explore does not answer; is it still running?");
  }
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer;
}

export const isStatic = data !== null;

export async function loadMap() {
  return data ? data.map : (await asked("map")).json();
}

// Whether any point of the map can be tossed, or those of the grid alone.
export const anywhere = !data || Boolean(data.engine);

// The pixels whose tosses are in the page: null where there is a server, else sorted columns and rows.
export const grid = data && { columns: data.columns, rows: data.rows };

export async function toss(engine, place) {
  if (data) {
    const held = data.tosses[`${place.u},${place.v}`]?.find((one) => one.engine === engine);
    if (held) return held;
    return engine === "analytic" ? tossedHere(place) : { engine, problem: "tossed only where there is a dot. The analytic engine tosses any pixel here." };
  }
  const query = new URLSearchParams({ x: String(place.x), y: String(place.y), engine });
  return (await (await asked(`toss?${query}`)).json())[0];
}

let started = null;

// The engine in the page, on workers; it is started when it is first asked.
const workers = () => (started ??= unpacked(data.engine.wasm).then((bytes) => startWorkers(bytes)));

// The toss of a point by the engine in the page, as the server gives it.
async function tossedHere(place) {
  const { x, y } = data.map.axes, { scenario, samples, most } = data.engine;
  const tossed = await (await workers()).toss(changed(scenario, { [x.field]: place.x, [y.field]: place.y }), samples);
  return tossed.count === most ? { ...tossed, ending: `It is shown up to impact ${most}.` } : tossed;
}

// Outcomes of a tile of a finer map, row by row, as compare/explorer/finer.py gives them.
export async function tile(level, column, row) {
  if (data) return tiledHere(level, column, row);
  const answer = await asked(`tile?${new URLSearchParams({ level, column, row })}`);
  return new Int8Array(await answer.arrayBuffer());
}

async function tiledHere(level, column, row) {
  const { axes, after } = data.map, codes = new Int8Array(SIDE * SIDE).fill(-1);
  const x = partOf(axes.x, level, column), y = partOf(axes.y, level, row);
  if (!x || !y) return codes;
  await (await workers()).map(data.engine.scenario, x, y, { after }, ({ pixels, codes: found }) =>
    pixels.forEach((pixel, at) => (codes[(y.first + Math.floor(pixel / x.count)) * SIDE + x.first + (pixel % x.count)] = found[at])));
  return codes;
}

// The part of an axis that a tile has, and where in the tile it begins; null for none.
function partOf(axis, level, number) {
  const places = Array.from({ length: SIDE }, (_, k) => (number * SIDE + k + 0.5) / 2 ** level - 0.5);
  const inside = places.filter((place) => place >= 0 && place <= axis.count - 1);
  if (!inside.length) return null;
  const [start, stop] = [inside[0], inside.at(-1)].map((place) => axis.start + place * ((axis.stop - axis.start) / (axis.count - 1)));
  return { field: axis.field, start, stop, count: inside.length, first: places.indexOf(inside[0]) };
}
