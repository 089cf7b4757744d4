// The map of the lab: tossed anew while its scenario or its window changes, coarse pixels first.

import { indexOf, valueAt } from "./axes.js";
import { drawCursor, drawHatch, makeView, style } from "./map_view.js";
import { colorsOf } from "./pixels.js";
import { ellipse } from "./hand.js";

const PIXEL = 2; // of the map, in those of the screen
const ULP = 2 ** -52;
const PATIENCE = 500; // milliseconds for which a server, which gives all pixels at once, is waited for
const FAR = 2 ** 20; // the stride of a pixel that nothing stands for yet

// `fields` has the word and the unit of each field, `outcomes` { color } by code. `told` has what is called: place
// and choose, with { x, y, code, trusted }; moved, with both windows; end; progress, with the part that is tossed and whether coarse pixels cover the map; and
// problem, with a message.
export function makeLiveMap({ canvas, workers, fields, outcomes, told }) {
  let state = null, behind = null, job = null, next = null;
  const identity = { start: 0, stop: 1, count: 2 }; // u and v are the values themselves
  const worded = (axis) => ({ ...identity, word: fields[axis?.field]?.word ?? "", unit: fields[axis?.field]?.unit ?? "" });
  const windowOf = ({ x, y }) => ({ left: x.from, right: x.to, bottom: y.from, top: y.to });
  const chosen = () => ({ u: state.scenario[state.x.field] ?? 0, v: state.scenario[state.y.field] ?? 0 });
  const view = makeView({
    canvas, paint, step, hold: (window) => window, axes: () => ({ x: worded(state?.x), y: worded(state?.y) }), limits,
    whole: () => windowOf(state?.home ?? { x: { from: 0, to: 1 }, y: { from: 0, to: 1 } }),
    about: () => state && chosen(),
    hover: (u, v) => state && told.place(place(u, v)),
    choose: (u, v) => state && told.choose(place(u, v)),
    moved: () => told.moved(windows()),
    end: (isEnd) => told.end(isEnd),
  });

  function windows() {
    const { left, right, bottom, top } = view.window();
    return { x: { ...state.x, from: left, to: right }, y: { ...state.y, from: bottom, to: top } };
  }

  // The values at the centres of the pixels that are seen.
  function grid() {
    const { width, height } = view.frame(), { left, right, bottom, top } = view.window();
    const axis = (field, low, high, size) => {
      const count = Math.max(Math.round(size / PIXEL), 2), half = (high - low) / count / 2;
      return { field, start: low + half, stop: high - half, count };
    };
    return { x: axis(state.x.field, left, right, width), y: axis(state.y.field, bottom, top, height) };
  }

  // A window in which neighbouring pixels differ by the last bit is the smallest.
  function limits({ left, right, bottom, top }) {
    const { width, height } = view.frame();
    const least = (low, high, size) => (ULP * Math.max(Math.abs(low), Math.abs(high)) * (size / PIXEL)) / (high - low);
    return { least: Math.max(least(left, right, width), least(bottom, top, height)), most: 1e3 };
  }

  // The pixel below a point, of what was tossed last.
  function place(u, v) {
    const { x, y } = grid();
    const at = (axis, value) => Math.min(Math.max(Math.round(indexOf(axis, value)), 0), axis.count - 1);
    const i = at(x, u), j = at(y, v), known = job && job.x.start === x.start && job.x.stop === x.stop && job.y.start === y.start;
    const index = j * x.count + i;
    return { x: valueAt(x, i), y: valueAt(y, j), code: known ? job.codes[index] : -1, trusted: known && state.trust ? job.trusted[index] : null };
  }

  function step(columns, rows) {
    const { x, y } = grid(), { u, v } = chosen();
    const along = (axis, value, by) => {
      const at = Math.round(indexOf(axis, value)), wide = (axis.stop - axis.start) / (axis.count - 1);
      const inside = at + by >= 0 && at + by < axis.count && Math.abs(valueAt(axis, at) - value) < wide;
      return by === 0 && !(at >= 0 && at < axis.count) ? value : inside ? valueAt(axis, at + by) : value + by * wide;
    };
    const to = { u: along(x, u, columns), v: along(y, v, rows) };
    view.reveal(to.u, to.v);
    told.choose(place(to.u, to.v));
  }

  // Everything that decides the colour of a pixel.
  function keyOf(at) {
    const others = Object.entries(state.scenario).filter(([field]) => field !== state.x.field && field !== state.y.field);
    return JSON.stringify([others, at, state.after, state.trust]);
  }

  function update(now) {
    const isOther = !state || ["x", "y"].some((name) => ["field", "from", "to"].some((key) => state[name][key] !== now[name][key]));
    const isNewMap = !state || state.x.field !== now.x.field || state.y.field !== now.y.field;
    state = { ...now, home: isNewMap ? { x: now.x, y: now.y } : (now.home ?? state.home) };
    if (isNewMap) {
      job?.controller.abort();
      behind = job = null;
    }
    if (isOther) {
      const { left, right, bottom, top } = view.window(), to = windowOf(now);
      if (left !== to.left || right !== to.right || bottom !== to.bottom || top !== to.top) view.show(to);
    }
    view.redraw();
    ask();
  }

  // A picture of coarse pixels is always finished, so that stripes bend while a slider moves; what is finer is dropped.
  function ask() {
    if (!state) return;
    const at = grid(), key = keyOf(at);
    if (job?.key === key) return void (next = null);
    if (job && !job.isCoarse && !job.isEnded && !(workers.tossMap && performance.now() - job.begun >= PATIENCE)) {
      if (workers.tossMap) setTimeout(ask, PATIENCE);
      return void (next = key);
    }
    begin(at, key);
  }

  async function begin({ x, y }, key) {
    job?.controller.abort();
    if (job?.isCoarse) behind = job;
    next = null;
    const size = x.count * y.count;
    const mine = { key, begun: performance.now(), x, y, window: view.window(), codes: new Int8Array(size).fill(-1), trusted: new Int8Array(size).fill(1),
      strides: new Int32Array(size).fill(FAR), isTossed: new Uint8Array(size), covered: 0, tossed: 0, isCoarse: false, isEnded: false, controller: new AbortController(), ...layers(x, y) };
    job = mine;
    told.progress(0, false);
    const { scenario, after, trust } = state;
    try {
      await workers.map(scenario, x, y, { after, trust }, (part) => job === mine && take(mine, part), mine.controller.signal);
    } catch (error) {
      if (error.name !== "AbortError") told.problem(error.message);
    }
    mine.isEnded = true;
    if (job === mine && next !== null) ask();
  }

  function layers(x, y) {
    const made = () => Object.assign(document.createElement("canvas"), { width: x.count, height: y.count });
    const picture = made(), hatch = made();
    return { picture, hatch, pixels: picture.getContext("2d").createImageData(x.count, y.count), lines: hatch.getContext("2d").createImageData(x.count, y.count) };
  }

  function take(job, { stride, columns, rows, codes, trusted }) {
    const colors = colorsOf(outcomes), { x, y } = job;
    rows.forEach((row, j) => columns.forEach((column, i) => {
      const code = codes[j * columns.length + i], trust = trusted ? trusted[j * columns.length + i] : 1;
      const [red, green, blue] = colors[code] ?? colors[-1];
      job.isTossed[row * x.count + column] = 1;
      for (let b = row; b < Math.min(row + stride, y.count); b++) {
        for (let a = column; a < Math.min(column + stride, x.count); a++) {
          const at = 4 * ((y.count - 1 - b) * x.count + a), index = b * x.count + a;
          if (job.strides[index] < stride) continue;
          if (job.strides[index] === FAR) job.covered += 1;
          job.strides[index] = stride;
          job.pixels.data[at] = red;
          job.pixels.data[at + 1] = green;
          job.pixels.data[at + 2] = blue;
          job.pixels.data[at + 3] = 255;
          job.lines.data.fill(trust || code < 0 ? 0 : 255, at, at + 4);
          job.codes[index] = code;
          job.trusted[index] = trust;
        }
      }
    }));
    job.isDrawn = false;
    job.tossed += rows.length * columns.length;
    job.isCoarse = job.covered === x.count * y.count;
    told.progress(job.tossed / (x.count * y.count), job.isCoarse);
    view.redraw();
    if (job.isCoarse && next !== null) ask();
  }

  function paint(pen, at) {
    if (!state) return;
    const spread = ({ window: { left, right, bottom, top } }) => [at.across(left), at.down(top), at.across(right) - at.across(left), at.down(bottom) - at.down(top)];
    const shown = job?.isCoarse ? [behind, job] : [behind ?? job];
    pen.imageSmoothingEnabled = false;
    for (const each of shown.filter(Boolean)) pen.drawImage(drawn(each).picture, ...spread(each));
    const last = shown.at(-1);
    if (state.trust && last) drawHatch(pen, at, last.hatch, spread(last));
    const half = { u: (at.window.right - at.window.left) / at.box.width, v: (at.window.top - at.window.bottom) / at.box.height };
    if (state.hand !== null) drawHand(pen, at);
    if (state.before) outline(pen, at, state.before);
    drawCursor(pen, at, chosen(), half);
  }

  function drawn(job) {
    if (!job.isDrawn) {
      job.picture.getContext("2d").putImageData(job.pixels, 0, 0);
      job.hatch.getContext("2d").putImageData(job.lines, 0, 0);
    }
    job.isDrawn = true;
    return job;
  }

  function drawHand(pen, { across, down }) {
    const points = ellipse(state, state.hand);
    for (const [color, width] of [["#fff", 5], [style("--cursor"), 2.5]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.beginPath();
      for (const [u, v] of points) pen.lineTo(across(u), down(v));
      pen.stroke();
    }
  }

  function outline(pen, { across, down }, [u, v]) {
    for (const [color, width] of [["#fff", 4], [style("--mujoco"), 2]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.strokeRect(across(u) - 5, down(v) - 5, 10, 10);
    }
  }

  new ResizeObserver(() => ask()).observe(canvas);
  return {
    update, grid,
    zoom: view.zoom,
    showWhole: view.showWhole,
    // What is seen: codes row by row, and of which pixels they are their own.
    seen: () => job,
  };
}
