// The picture of a map while it is tossed: smooth from the first tosses, and each row in its own colours when all of it is tossed.

import { style } from "./map_view.js";
import { reconstruct } from "./reconstruct.js";

// A picture of a map over axes as in axes.js. Of each pixel it has the code, whether it is trusted, and whether it was tossed;
// `tossed` counts these, and `isCoarse` says that there are some all over the map.
export function makePicture({ x, y, outcomes, trust }) {
  const columns = x.count, rows = y.count, size = columns * rows;
  const made = { x, y, codes: new Int8Array(size).fill(-1), trusted: new Int8Array(size).fill(1), isTossed: new Uint8Array(size), tossed: 0, isCoarse: false };
  const [image, hatch] = [true, trust].map((isWanted) => isWanted && Object.assign(document.createElement("canvas"), { width: columns, height: rows }));
  const [pixels, lines] = [image, hatch].map((canvas) => canvas && new ImageData(columns, rows));
  const colors = colorsOf(outcomes), left = new Int32Array(rows).fill(columns), place = (row) => (rows - 1 - row) * columns;
  let stride = null, isDrawn = true;

  function putRow(row) {
    for (let column = 0; column < columns; column++) {
      const pixel = row * columns + column, at = 4 * (place(row) + column), code = made.codes[pixel];
      pixels.data.set(colors[code] ?? colors[-1], at);
      pixels.data[at + 3] = 255;
      if (lines) lines.data.fill(code >= 0 && !made.trusted[pixel] ? 255 : 0, at, at + 4);
    }
  }

  function putSmooth() {
    const found = reconstruct({ columns, rows, stride, codes: made.codes, trusted: trust ? made.trusted : null, colors });
    for (let row = 0; row < rows; row++) {
      if (!left[row]) continue;
      pixels.data.set(found.pixels.subarray(4 * row * columns, 4 * (row + 1) * columns), 4 * place(row));
      if (lines) for (let column = 0; column < columns; column++) lines.data.fill(found.doubts[row * columns + column], 4 * (place(row) + column), 4 * (place(row) + column) + 4);
    }
  }

  // Takes a part of the map, as of workers.d.ts; returns whether there is something else to see.
  made.take = ({ pixels: some, codes, trusted, finished }) => {
    const ended = new Set();
    some.forEach((pixel, i) => {
      made.codes[pixel] = codes[i];
      if (trusted) made.trusted[pixel] = trusted[i];
      if (made.isTossed[pixel]) return;
      const row = Math.floor(pixel / columns);
      made.isTossed[pixel] = 1;
      made.tossed += 1;
      left[row] -= 1;
      if (!left[row]) ended.add(row);
    });
    const isFiner = finished !== null && finished !== stride;
    stride = finished;
    if (isFiner && stride > 1) putSmooth();
    for (const row of ended) putRow(row);
    made.isCoarse ||= isFiner;
    isDrawn &&= !isFiner && !ended.size;
    return isFiner || ended.size > 0;
  };

  // The canvases of the picture and, where doubts were asked for, of their mask.
  made.drawn = () => {
    for (const [canvas, data] of isDrawn ? [] : [[image, pixels], [hatch, lines]]) if (canvas) canvas.getContext("2d").putImageData(data, 0, 0);
    isDrawn = true;
    return { image, hatch };
  };
  return made;
}

// The colours of outcomes by their codes, of -1 for what is not tossed; `outcomes` has { color } by code.
function colorsOf(outcomes) {
  const named = [["-1", style("--untossed")], ...Object.entries(outcomes).map(([code, { color }]) => [code, color])];
  return Object.fromEntries(named.map(([code, color]) => [code, [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16))]));
}
