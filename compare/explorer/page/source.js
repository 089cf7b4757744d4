// Where the map and its tosses come from: the server, or the page itself where it is one file.

import { load } from "./engine.js";

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
    return engine === "analytic" ? tossedHere(place) : { engine, problem: "tossed only where there is a dot." };
  }
  const query = new URLSearchParams({ x: String(place.x), y: String(place.y), engine });
  return (await (await asked(`toss?${query}`)).json())[0];
}

let loaded = null;

// The toss of a point by the engine in the page, as the server gives it.
async function tossedHere(place) {
  const { wasm, numbers, release, places, coin, samples, most } = data.engine;
  loaded ??= load(Uint8Array.from(atob(wasm), (sign) => sign.charCodeAt(0)));
  const engine = await loaded, rows = { numbers: [...numbers], release: [...release] };
  [place.x, place.y].forEach((value, i) => (rows[places[i][0]][places[i][1]] = value));
  const toss = engine.toss(rows.numbers, rows.release), { impacts, endTime } = toss, shown = impacts.slice(0, samples / 4);
  const even = Array.from({ length: samples }, (_, i) => (i * endTime) / (samples - 1));
  const hits = shown.flatMap(({ time }) => [time * (1 - 2 ** -52), time]);
  const times = [...new Set([...even, ...hits])].filter((time) => time <= endTime).sort((a, b) => a - b);
  const { states, energies } = toss.path(times), part = (first, count) => times.flatMap((_, i) => [...states.subarray(13 * i + first, 13 * i + first + count)]);
  return {
    engine: "analytic",
    outcome: toss.outcome,
    ending: impacts.length === most ? `It is shown up to impact ${most}.` : toss.sentence,
    end_time: endTime,
    count: impacts.length,
    sequence: toss.sequence.slice(0, shown.length),
    times: shown.map(({ time }) => time),
    trusted: toss.trustedImpacts,
    notes: [],
    coin,
    path: { time: times, position: part(0, 3), quaternion: part(6, 4), energy: [...energies] },
  };
}

// Outcomes of a tile of a finer map, row by row.
export async function tile(level, column, row) {
  const answer = await asked(`tile?${new URLSearchParams({ level, column, row })}`);
  return new Int8Array(await answer.arrayBuffer());
}
