// The map of the lab: tossed again whenever its scenario or its window changes, coarse pixels first. A map that was made
// before is shown as it is, until one changes it, or zooms past its pixels.

import { indexOf, valueAt } from "./axes.js";
import { drawCursor, drawHatch, makeView, stroked, style } from "./map_view.js";
import { nearestOther, nearestText } from "./nearest.js";
import { makePicture } from "./picture.js";
import { ellipse } from "./hand.js";

const PIXEL = 2, SLOW = 8; // of the map, in those of the screen; where MuJoCo tosses
const COARSE = 9; // a pixel of a map that was made is too large from here on [px]
const NEAR = 10; // a click so near to a dot chooses it [px]
const ULP = 2 ** -52;
const WIDEST = 8; // times the whole map: the widest window
const FRAME = 80; // [ms] between two pictures of one map
const AROUND = 41; // pixels along both sides of a map around the one that is seen

// `fields` has the word and the unit of each field, `outcomes` { color } by code. `told` has callbacks: place
// and choose, with { x, y, code, trusted }; moved, with both windows; end; nearest, with a text; progress, with the part that is tossed and
// whether coarse pixels cover the map; and problem, with a message.
// `saved` is a map as of saved.js, or null. `marks` returns the dots on the map, each with { values } by field and a color.
export function makeLiveMap({ canvas, workers, fields, outcomes, saved, marks, told }) {
  const size = saved?.engine === "mujoco" ? SLOW : PIXEL;
  let state = null, behind = null, job = null, next = null, drawn = 0, isLast = false;
  const worded = (axis) => ({ word: fields[axis?.field]?.word ?? "", unit: fields[axis?.field]?.unit ?? "" });
  const windowOf = ({ x, y }) => ({ left: x.from, right: x.to, bottom: y.from, top: y.to });
  const chosen = () => ({ u: state.scenario[state.x.field] ?? 0, v: state.scenario[state.y.field] ?? 0 });
  const view = makeView({
    canvas, paint, step, axes: () => ({ x: worded(state?.x), y: worded(state?.y) }), limits,
    whole: () => windowOf(state?.home ?? { x: { from: 0, to: 1 }, y: { from: 0, to: 1 } }),
    about: () => state && chosen(),
    hover: (u, v) => state && told.place(place(u, v)),
    choose: (u, v) => state && told.choose(dotAt(u, v) ?? place(u, v)),
    moved() {
      const { left, right, bottom, top } = view.window();
      if (state) told.moved({ x: { ...state.x, from: left, to: right }, y: { ...state.y, from: bottom, to: top } });
    },
    end: (isEnd) => told.end((isLast = isEnd)),
  });

  // The values at the centres of the pixels that are seen.
  function grid() {
    const { width, height } = view.frame(), { left, right, bottom, top } = view.window();
    const axis = (field, low, high, long) => {
      const count = Math.max(Math.round(long / size), 2), half = (high - low) / count / 2;
      return { field, start: low + half, stop: high - half, count };
    };
    return { x: axis(state.x.field, left, right, width), y: axis(state.y.field, bottom, top, height) };
  }

  // The pixels that one steps through.
  const pixels = () => (saved && job === saved ? saved : grid());

  // Whether the map that was made is to be seen: all of it, or a part in which its pixels are small; between whole numbers there is nothing.
  function isSaved() {
    if (!saved?.shows(state)) return false;
    const { width, height } = view.frame(), home = saved.window, { left, right, bottom, top } = view.window();
    const wide = (home.right - home.left) / (right - left), high = (home.top - home.bottom) / (top - bottom);
    const whole = Math.max(width / saved.x.count, height / saved.y.count), now = Math.max((wide * width) / saved.x.count, (high * height) / saved.y.count);
    return [saved.x, saved.y].some(({ field }) => fields[field].whole) || (now <= Math.max(COARSE, 1.5 * whole) && Math.min(wide, high) > 0.99);
  }

  // A window in which neighbouring pixels differ by the last bit is the smallest.
  function limits({ left, right, bottom, top }) {
    const { width, height } = view.frame();
    const least = (low, high, long) => (ULP * Math.max(Math.abs(low), Math.abs(high)) * (long / size)) / (high - low);
    const home = windowOf(state.home), part = Math.max((right - left) / (home.right - home.left), (top - bottom) / (home.top - home.bottom));
    return { least: Math.max(least(left, right, width), least(bottom, top, height)), most: WIDEST / part };
  }

  // What MuJoCo has tossed near a point, null for nothing.
  function dotAt(u, v) {
    const { width, height } = view.frame(), { left, right, bottom, top } = view.window();
    const far = ({ values: { [state.x.field]: x, [state.y.field]: y } }) => Math.hypot(((x - u) / (right - left)) * width, ((y - v) / (top - bottom)) * height);
    const found = saved?.shows(state) && saved.dots.find((each) => far(each) <= NEAR)?.values;
    return found ? { ...place(found[state.x.field], found[state.y.field]), x: found[state.x.field], y: found[state.y.field] } : null;
  }

  // The pixel below a point, of what was tossed last.
  function place(u, v) {
    if (saved && job === saved) return saved.place(u, v);
    const { x, y } = grid();
    const at = (axis, value) => Math.min(Math.max(Math.round(indexOf(axis, value)), 0), axis.count - 1);
    const i = at(x, u), j = at(y, v), known = job && job.x.start === x.start && job.x.stop === x.stop && job.y.start === y.start;
    const index = j * x.count + i;
    return { x: valueAt(x, i), y: valueAt(y, j), code: known ? job.codes[index] : -1, trusted: known && state.trust ? job.trusted[index] : null };
  }

  function step(columns, rows) {
    const { x, y } = pixels(), { u, v } = chosen();
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
    const isNewMap = !state || state.x.field !== now.x.field || state.y.field !== now.y.field;
    state = now;
    if (isNewMap) job?.controller?.abort();
    if (isNewMap) behind = job = null;
    const seen = view.window(), to = windowOf(now);
    if (Object.keys(to).some((side) => seen[side] !== to[side])) view.show(to);
    view.redraw();
    ask();
  }

  // A picture of coarse pixels is always finished, so that stripes bend while a slider moves; what is finer is dropped.
  function ask() {
    if (!state) return;
    if (isSaved()) return showSaved();
    const at = grid(), key = keyOf(at);
    if (job?.key === key) next = null;
    else if (job && !job.isCoarse && !job.isEnded) next = key;
    else begin(at, key);
  }

  function showSaved() {
    if (job !== saved) job?.controller.abort();
    [job, behind, next] = [saved, null, null];
    told.nearest("");
    told.progress(1, true);
  }

  async function begin({ x, y }, key) {
    job?.controller?.abort();
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
    const isDue = isOther && (!wasCoarse || isWhole || now - drawn > FRAME);
    if (isDue) drawn = now;
    if (isDue) view.redraw();
    if (job.isCoarse && next !== null) ask();
  }

  function paint(pen, at) {
    if (!state) return;
    const spread = ({ window: { left, right, bottom, top } }) => [at.across(left), at.down(top), at.across(right) - at.across(left), at.down(bottom) - at.down(top)];
    const shown = [saved?.shows(state) && saved, behind, job].filter((each, i, all) => each?.isCoarse && all.lastIndexOf(each) === i);
    for (const each of shown) {
      pen.imageSmoothingEnabled = each === saved ? spread(each)[2] < saved.x.count : each !== job; // of another window it may be enlarged
      pen.drawImage(each.drawn().image, ...spread(each));
    }
    const last = shown.at(-1), hatch = last?.drawn().hatch;
    if (state.trust && hatch) drawHatch(pen, at, hatch, spread(last));
    const { x, y } = pixels(), half = ({ start, stop, count }) => (stop - start) / (count - 1) / 2;
    const hand = state.hand === null ? [] : ellipse(state, state.hand);
    stroked(pen, [["#fff", 3.5], ["#000", 2.5, [7, 6]]], () => hand.forEach(([u, v]) => pen.lineTo(at.across(u), at.down(v))));
    for (const mark of marks()) dot(pen, at, mark);
    const [u, v] = state.before ?? [];
    if (state.before) stroked(pen, [["#fff", 4], [style("--mujoco"), 2]], () => pen.rect(at.across(u) - 5, at.down(v) - 5, 10, 10));
    drawCursor(pen, at, chosen(), { u: half(x), v: half(y) });
    drawDepth(pen, at.box);
  }

  // How wide the window is, in the upper right corner where it is not the whole.
  function drawDepth(pen, box) {
    const { left, right } = view.window(), home = windowOf(state.home), text = depthText((right - left) / (home.right - home.left), isLast);
    if (!text) return;
    Object.assign(pen, { font: `600 14px ${getComputedStyle(document.body).fontFamily}`, textAlign: "right", textBaseline: "middle", fillStyle: style("--card") });
    const wide = pen.measureText(text).width + 14, x = box.left + box.width - 6;
    pen.beginPath();
    pen.roundRect(x - wide, box.top + 6, wide, 25, 6);
    pen.fill();
    pen.fillStyle = style("--ink");
    pen.fillText(text, x - 7, box.top + 19);
  }

  function dot(pen, { across, down }, { values, color, ring = "#fff", size = 6 }) {
    const [u, v] = [values[state.x.field], values[state.y.field]];
    if (u === undefined || v === undefined) return;
    pen.fillStyle = color;
    stroked(pen, [[ring, 0.4 * size]], () => {
      pen.arc(across(u), down(v), size, 0, 2 * Math.PI);
      pen.fill();
    });
  }

  new ResizeObserver(() => ask()).observe(canvas);
  // What is seen has codes row by row, and of which pixels they are their own.
  return { update, grid: pixels, zoom: view.zoom, showWhole: view.showWhole, seen: () => job };
}

// The width of a window as a part of the whole map's; nothing for the whole.
export function depthText(part, isLast = false) {
  if (Math.abs(part - 1) < 1e-3) return "";
  const number = part < 0.1 ? part.toExponential(1).replace(".0e", "e") : String(Number(part.toPrecision(2)));
  return `${number} of the map${isLast ? "; doubles end here" : ""}`;
}
