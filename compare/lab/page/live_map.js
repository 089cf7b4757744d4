// The map of the lab: tossed again whenever its scenario or its window changes, coarse pixels first.

import { indexOf, valueAt } from "./axes.js";
import { drawCursor, drawHatch, makeView } from "./map_view.js";
import { nearestOther, nearestText } from "./nearest.js";
import { makePicture } from "./picture.js";
import { style } from "./pixels.js";
import { ellipse } from "./hand.js";

const PIXEL = 2; // of the map, in those of the screen
const ULP = 2 ** -52;
const WIDEST = 8; // times the whole map: the widest window
const FRAME = 80; // [ms] between two pictures of one map
const AROUND = 41; // pixels along both sides of a map around the one that is seen

// `fields` has the word and the unit of each field, `outcomes` { color } by code. `told` has callbacks: place
// and choose, with { x, y, code, trusted }; moved, with both windows; end; nearest, with a text; progress, with the part that is tossed and
// whether coarse pixels cover the map; problem, with a message; and optionally depth, with a text.
// `marks` returns the dots on the map, each with { values } by field and a color.
export function makeLiveMap({ canvas, workers, fields, outcomes, marks, told }) {
  let state = null, behind = null, job = null, next = null, drawn = 0, isLast = false, depth = "";
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
    end(isEnd) {
      isLast = isEnd;
      told.end(isEnd);
    },
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
    const home = windowOf(state.home), part = Math.max((right - left) / (home.right - home.left), (top - bottom) / (home.top - home.bottom));
    return { least: Math.max(least(left, right, width), least(bottom, top, height)), most: WIDEST / part };
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
    if (job?.key === key) next = null;
    else if (job && !job.isCoarse && !job.isEnded) next = key;
    else begin(at, key);
  }

  async function begin({ x, y }, key) {
    job?.controller.abort();
    if (job?.isCoarse) behind = job;
    next = null;
    const { scenario, after, trust } = state;
    const mine = Object.assign(makePicture({ x, y, outcomes, trust }), { key, window: view.window(), isEnded: false, controller: new AbortController() });
    job = mine;
    told.progress(0, false);
    told.nearest("");
    try {
      await workers.map(scenario, x, y, { after, trust }, (part) => job === mine && take(part), mine.controller.signal);
      if (mine.codes.every((code) => code === mine.codes[0] && code >= 0)) await lookAround(mine, state);
    } catch (error) {
      if (error.name !== "AbortError") told.problem(error.message);
    }
    mine.isEnded = true;
    if (job === mine && next !== null) ask();
  }

  // Tosses maps around one of a single colour, each twice as wide as the one before, until they show another.
  async function lookAround({ x, y, codes: [code], window: { left, right, bottom, top }, controller: { signal } }, { scenario, after, home }) {
    const middle = [(left + right) / 2, (bottom + top) / 2], half = [(right - left) / 2, (top - bottom) / 2], center = (AROUND - 1) / 2;
    const codes = new Int8Array(AROUND ** 2), most = (WIDEST * (home.x.to - home.x.from)) / half[0];
    let way = null;
    for (let times = 2; !way && times <= most; times *= 2) {
      const [across, up] = [x, y].map(({ field }, i) => ({ field, start: middle[i] - times * half[i], stop: middle[i] + times * half[i], count: AROUND }));
      await workers.map(scenario, across, up, { after }, ({ pixels, codes: found }) => pixels.forEach((pixel, i) => (codes[pixel] = found[i])), signal);
      way = nearestOther(codes, AROUND, [center, center], code)?.map((pixels, i) => (pixels / center) * times * half[i]);
    }
    told.nearest(nearestText(outcomes[code].label, way, [worded(x), worded(y)]));
  }

  function take(part) {
    const wasCoarse = job.isCoarse, isOther = job.take(part), isWhole = job.tossed === job.codes.length, now = performance.now();
    told.progress(job.tossed / job.codes.length, job.isCoarse);
    if (isOther && (!wasCoarse || isWhole || now - drawn > FRAME)) {
      drawn = now;
      view.redraw();
    }
    if (job.isCoarse && next !== null) ask();
  }

  function paint(pen, at) {
    if (!state) return;
    const spread = ({ window: { left, right, bottom, top } }) => [at.across(left), at.down(top), at.across(right) - at.across(left), at.down(bottom) - at.down(top)];
    const shown = [behind, job].filter((each) => each?.isCoarse);
    for (const each of shown) {
      pen.imageSmoothingEnabled = each !== job; // of another window it may be enlarged
      pen.drawImage(each.drawn().image, ...spread(each));
    }
    const last = shown.at(-1), hatch = last?.drawn().hatch;
    if (state.trust && hatch) drawHatch(pen, at, hatch, spread(last));
    const half = { u: (at.window.right - at.window.left) / at.box.width, v: (at.window.top - at.window.bottom) / at.box.height };
    if (state.hand !== null) drawHand(pen, at);
    for (const mark of marks()) dot(pen, at, mark);
    if (state.before) outline(pen, at, state.before);
    drawCursor(pen, at, chosen(), half);
    drawDepth(pen, at.box);
  }

  // How wide the window is, in the upper right corner where it is not the whole.
  function drawDepth(pen, box) {
    const { left, right } = view.window(), home = windowOf(state.home), text = depthText((right - left) / (home.right - home.left), isLast);
    if (text !== depth) told.depth?.(text);
    depth = text;
    if (!text) return;
    pen.font = `600 14px ${getComputedStyle(document.body).fontFamily}`;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    const wide = pen.measureText(text).width + 14, x = box.left + box.width - 6;
    pen.fillStyle = style("--card");
    pen.beginPath();
    pen.roundRect(x - wide, box.top + 6, wide, 25, 6);
    pen.fill();
    pen.fillStyle = style("--ink");
    pen.fillText(text, x - 7, box.top + 19);
  }

  function drawHand(pen, { across, down }) {
    const points = ellipse(state, state.hand);
    pen.save();
    for (const [color, width, dashes] of [["#fff", 3.5, []], ["#000", 2.5, [7, 6]]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.setLineDash(dashes);
      pen.beginPath();
      for (const [u, v] of points) pen.lineTo(across(u), down(v));
      pen.stroke();
    }
    pen.restore();
  }

  function dot(pen, { across, down }, { values, color }) {
    const [u, v] = [values[state.x.field], values[state.y.field]];
    if (u === undefined || v === undefined) return;
    pen.beginPath();
    pen.arc(across(u), down(v), 6, 0, 2 * Math.PI);
    pen.fillStyle = color;
    pen.fill();
    pen.lineWidth = 2.5;
    pen.strokeStyle = "#fff";
    pen.stroke();
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

// The width of a window as a part of the whole map's; nothing for the whole.
export function depthText(part, isLast = false) {
  if (Math.abs(part - 1) < 1e-3) return "";
  const number = part < 0.1 ? part.toExponential(1).replace(".0e", "e") : String(Number(part.toPrecision(2)));
  return `${number} of the map${isLast ? "; doubles end here" : ""}`;
}
