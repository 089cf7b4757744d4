// The map of a lab that is served: its server tosses it.

/** The codes of a whole map, and whether each is trusted; see workers.d.ts and compare/lab/served.py. */
export async function tossedThere({ row, x, y, after, trust }, signal) {
  const numbers = hexadecimal(Float64Array.of(...row, x.start, x.stop, y.start, y.stop));
  const asked = { numbers, x: x.field, y: y.field, columns: x.count, rows: y.count, after: after ?? "final", trust: Number(trust) };
  let answer;
  try {
    answer = await fetch(`map?${new URLSearchParams(asked)}`, { signal });
  } catch (problem) {
    throw problem.name === "AbortError" ? problem : new Error("cointoss lab does not answer; is it still running?");
  }
  if (!answer.ok) throw new Error((await answer.text()).trim());
  const octets = new Int8Array(await answer.arrayBuffer()), size = x.count * y.count;
  return { codes: octets.subarray(0, size), trusted: trust ? octets.subarray(size) : null };
}

// No decimal keeps the sign of zero, and JSON has no NaN.
const hexadecimal = (numbers) => Array.from(new Uint8Array(numbers.buffer), (octet) => octet.toString(16).padStart(2, "0")).join("");
