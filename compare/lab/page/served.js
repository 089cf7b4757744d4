// What a page that is served asks its server for; see compare/lab/served.py.

/** The codes of a whole map, and whether each is trusted; see workers.d.ts. */
export async function tossedThere({ row, x, y, after, trust }, signal) {
  const numbers = hexadecimal(Float64Array.of(...row, x.start, x.stop, y.start, y.stop));
  const asked = { numbers, x: x.field, y: y.field, columns: x.count, rows: y.count, after: after ?? "final", trust: Number(trust) };
  const octets = new Int8Array(await (await answered("map", asked, signal)).arrayBuffer()), size = x.count * y.count;
  return { codes: octets.subarray(0, size), trusted: trust ? octets.subarray(size) : null };
}

/** The toss of a row by MuJoCo, or what keeps it from one. */
export async function tossedByMujoco(row) {
  try {
    return await (await answered("toss", { numbers: hexadecimal(row) })).json();
  } catch ({ message }) {
    return { engine: "mujoco", problem: message };
  }
}

export const savedThere = async () => (await answered("saved", {})).json();

async function answered(path, asked, signal) {
  let answer;
  try {
    answer = await fetch(`${path}?${new URLSearchParams(asked)}`.replace(/\?$/, ""), { signal });
  } catch (problem) {
    throw problem.name === "AbortError" ? problem : new Error("cointoss does not answer; is it still running?");
  }
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer;
}

// No decimal keeps the sign of zero, and JSON has no NaN.
const hexadecimal = (numbers) => Array.from(new Uint8Array(numbers.buffer), (octet) => octet.toString(16).padStart(2, "0")).join("");
