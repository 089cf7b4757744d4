// Where the map and its tosses come from: the server, or the page itself where it is one file.

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

// The pixels that can be tossed: null for all, else sorted columns and rows.
export const grid = data && { columns: data.columns, rows: data.rows };

export async function toss(engine, place) {
  if (data) return data.tosses[`${place.u},${place.v}`].find((one) => one.engine === engine);
  const query = new URLSearchParams({ x: String(place.x), y: String(place.y), engine });
  return (await (await asked(`toss?${query}`)).json())[0];
}

// Outcomes of a tile of a finer map, row by row.
export async function tile(level, column, row) {
  const answer = await asked(`tile?${new URLSearchParams({ level, column, row })}`);
  return new Int8Array(await answer.arrayBuffer());
}
