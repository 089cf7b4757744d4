// A smooth picture of a map from few of its tosses: their colours where neighbours agree, the mixture where they do not.

const REACH = 1.5; // of a toss, in squares of the stride
const FAR = 2; // squares to each side over which is averaged where neighbours disagree
const ABOUT = 3; // squares to each side over which is counted what part of neighbours disagree
const ORDER = 0.22, NOISE = 0.38; // parts of neighbours that disagree: below there are stripes, above their mixture is drawn
const SUMS = 5; // of weights, and of red, green, blue and doubt by weight

// The colours and doubts of all pixels of a map. `codes` are -1 where a pixel is not tossed, and one is in each square of
// `stride` pixels; `trusted` has 0 for a toss that is doubted, or is null. Returns { pixels, doubts }, row by row, the
// first below: red, green, blue and 255, and doubts from 0 to 255.
export function reconstruct({ columns, rows, stride, codes, trusted, colors }) {
  const wide = Math.ceil((columns - 1) / stride) + 1, high = Math.ceil((rows - 1) / stride) + 1;
  const near = new Float32Array(SUMS * wide * high), cells = { wide: Math.ceil(columns / stride), high: Math.ceil(rows / stride) };
  const coarse = new Int8Array(cells.wide * cells.high).fill(-1);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const code = codes[row * columns + column];
      if (code === -1) continue;
      coarse[Math.floor(row / stride) * cells.wide + Math.floor(column / stride)] = code;
      add(near, wide, high, column / stride, row / stride, colors[code] ?? colors[-1], Number(trusted !== null && code >= 0 && !trusted[row * columns + column]));
    }
  }
  const far = summed(summed(near, wide, high, SUMS, FAR), wide, high, SUMS, FAR / 2), noise = disorder(coarse, cells.wide, cells.high);
  const nodes = new Float32Array(4 * wide * high);
  for (let node = 0; node < wide * high; node++) {
    const cell = Math.min(Math.floor(node / wide), cells.high - 1) * cells.wide + Math.min(node % wide, cells.wide - 1);
    const part = Math.min(Math.max((noise[cell] - ORDER) / (NOISE - ORDER), 0), 1), at = SUMS * node;
    for (let k = 0; k < 4; k++) nodes[4 * node + k] = (1 - part) * (near[at + 1 + k] / near[at]) + part * (far[at + 1 + k] / far[at]);
  }
  return between(nodes, wide, { columns, rows, stride });
}

// Adds a toss to the nodes about it, the less the farther; node (a, b) is at pixel (a, b) times the stride.
function add(sums, wide, high, u, v, [red, green, blue], doubt) {
  for (let b = Math.max(Math.ceil(v - REACH), 0); b <= Math.min(v + REACH, high - 1); b++) {
    for (let a = Math.max(Math.ceil(u - REACH), 0); a <= Math.min(u + REACH, wide - 1); a++) {
      const weight = (REACH + 1e-3 - Math.abs(a - u)) * (REACH + 1e-3 - Math.abs(b - v)), at = SUMS * (b * wide + a);
      sums[at] += weight;
      sums[at + 1] += weight * red;
      sums[at + 2] += weight * green;
      sums[at + 3] += weight * blue;
      sums[at + 4] += weight * doubt;
    }
  }
}

// The part of the neighbouring squares about each square whose tosses differ: half where they are as those of a fair coin.
function disorder(codes, wide, high) {
  const found = new Float32Array(2 * wide * high); // pairs that differ, and all
  for (let at = 0; at < wide * high; at++) {
    for (const next of [...(at % wide < wide - 1 ? [at + 1] : []), ...(at + wide < wide * high ? [at + wide] : [])]) {
      found[2 * at] += Number(codes[at] !== codes[next]);
      found[2 * at + 1] += 1;
    }
  }
  const sums = summed(found, wide, high, 2, ABOUT);
  return Float32Array.from({ length: wide * high }, (_, at) => sums[2 * at] / Math.max(sums[2 * at + 1], 1));
}

// Sums of tuples of `size` numbers over `reach` places to each side, and above and below.
function summed(values, wide, high, size, reach) {
  const made = Float32Array.from(values), sums = new Float64Array(Math.max(wide, high) + 1);
  const along = (from, step, count) => {
    for (let i = 0; i < count; i++) sums[i + 1] = sums[i] + made[from + i * step];
    for (let i = 0; i < count; i++) made[from + i * step] = sums[Math.min(i + reach + 1, count)] - sums[Math.max(i - reach, 0)];
  };
  for (let j = 0; j < high; j++) for (let k = 0; k < size; k++) along(j * wide * size + k, size, wide);
  for (let i = 0; i < wide; i++) for (let k = 0; k < size; k++) along(i * size + k, wide * size, high);
  return made;
}

function between(nodes, wide, { columns, rows, stride }) {
  const pixels = new Uint8ClampedArray(4 * columns * rows), doubts = new Uint8ClampedArray(columns * rows);
  const high = nodes.length / 4 / wide, part = (nodes, at, k, right, next) => nodes[at + k] + right * (nodes[next + k] - nodes[at + k]);
  for (let row = 0; row < rows; row++) {
    const below = Math.floor(row / stride), above = Math.min(below + 1, high - 1), up = row / stride - below;
    for (let column = 0; column < columns; column++) {
      const left = Math.floor(column / stride), step = left + 1 < wide ? 4 : 0, right = column / stride - left, pixel = row * columns + column;
      const low = 4 * (below * wide + left), top = 4 * (above * wide + left);
      for (let k = 0; k < 4; k++) {
        const from = part(nodes, low, k, right, low + step), value = from + up * (part(nodes, top, k, right, top + step) - from);
        if (k < 3) pixels[4 * pixel + k] = value;
        else doubts[pixel] = 255 * value;
      }
      pixels[4 * pixel + 3] = 255;
    }
  }
  return { pixels, doubts };
}
