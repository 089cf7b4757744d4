// The map that was made: its pixels, finer tiles where one zooms past them, and the pixel that is chosen.

import { valueAt } from "./axes.js";
import { clamp, drawCursor, drawHatch, makeView } from "./map_view.js";
import { nearestOther, nearestText } from "./nearest.js";
import { colorsOf, mask, picture } from "./pixels.js";

const SIDE = 32; // of a tile, in its own pixels
const FINEST = 30;
const COARSE = 9; // a pixel larger than this on the screen is cut finer
const KEPT = 400; // tiles
const AROUND = 10; // a click this near to a dot chooses the dot [px]
const LOOKS = 24; // places along both sides of a window at which is looked whether it has one colour

export function makeMap({ canvas, map, grid, anywhere, tile, onHover, onChoose, onNearest, onProblem }) {
  const { x, y } = map.axes, nx = x.count, ny = y.count;
  const codes = Int8Array.from(bytes(map.arrays.outcome));
  const stride = map.stride, columns = Math.ceil(nx / stride), rows = Math.ceil(ny / stride);
  const whole = () => ({ left: -stride / 2, right: (columns - 0.5) * stride, bottom: -stride / 2, top: (rows - 0.5) * stride });
  const tiles = new Map();
  let chosen = null, queue = [], busy = false, failed = false;

  const drawn = () => picture(codes, columns, rows, colorsOf(map.outcomes));
  let base = drawn();
  const untrusted = map.arrays.untrusted ? mask(Int8Array.from(bytes(map.arrays.untrusted)), columns, rows) : null;
  // Before the view, which draws again after this.
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => (base = drawn()));

  const view = makeView({
    canvas, whole, paint, step, axes: () => map.axes, about: () => chosen,
    hold: middleOnTheMap,
    limits: ({ left, right }) => ({ least: 16 / 2 ** (tile ? 28 : 2) / (right - left), most: (2 * nx) / (right - left) }),
    hover: (u, v) => onHover(place(u, v)),
    choose: (u, v) => choose(u, v),
  });

  function middleOnTheMap(window) {
    const by = (low, high, count) => clamp((low + high) / 2, -0.5, count - 0.5) - (low + high) / 2;
    const dx = by(window.left, window.right, nx), dy = by(window.bottom, window.top, ny);
    return { left: window.left + dx, right: window.right + dx, bottom: window.bottom + dy, top: window.top + dy };
  }

  // The level at which the pixels on the screen are small enough; 0 for the map's own, as long as one is not past them.
  function level() {
    if (!tile) return 0;
    const box = view.frame(), size = (part) => stride * Math.max(box.width / (part.right - part.left), box.height / (part.top - part.bottom));
    const now = size(view.window());
    return now <= Math.max(COARSE, 1.5 * size(whole())) ? 0 : clamp(Math.ceil(Math.log2(now / stride / COARSE)), 1, FINEST);
  }

  // The nearest pixel, of the finer map where it is shown, or that both engines have tossed.
  function snapped(u, v) {
    const dot = grid && { u: nearest(grid.columns, u), v: nearest(grid.rows, v) };
    return dot && (!anywhere || isNear(dot, u, v)) ? dot : cellAt(u, v);
  }

  function cellAt(u, v) {
    const cells = 2 ** level();
    const cell = (at, count) => clamp((Math.floor((at + 0.5) * cells) + 0.5) / cells - 0.5, 0, count - 1);
    const coarse = (at, count) => clamp(Math.round(at / stride) * stride, 0, count - 1);
    return cells === 1 ? { u: coarse(u, nx), v: coarse(v, ny) } : { u: cell(u, nx), v: cell(v, ny) };
  }

  function isNear(dot, u, v) {
    const box = view.frame(), { left, right, bottom, top } = view.window();
    return Math.hypot(((dot.u - u) / (right - left)) * box.width, ((dot.v - v) / (top - bottom)) * box.height) <= AROUND;
  }

  function place(u, v, exactly = false) {
    const at = exactly && anywhere ? { u, v } : snapped(u, v), index = indexAt(at);
    return { ...at, x: valueAt(x, at.u), y: valueAt(y, at.v), code: codeAt(at), index, step: 2 ** -level() * stride };
  }

  const indexAt = ({ u, v }) => (Number.isInteger(u / stride) && Number.isInteger(v / stride) ? (v / stride) * columns + u / stride : null);
  const codeAt = (at) => (indexAt(at) === null ? tileCode(at, level()) : codes[indexAt(at)]);

  // What is told of a window of one colour: where the map's own pixels have another; nothing of other windows.
  function lookAround({ left, right, bottom, top }) {
    const seen = new Set(), middle = [left + right, bottom + top].map((sum) => Math.round(sum / 2 / stride));
    for (let at = 0; at < LOOKS ** 2; at++) {
      const [a, b] = [at % LOOKS, Math.floor(at / LOOKS)].map((each) => (each + 0.5) / LOOKS);
      seen.add(codeAt(cellAt(left + a * (right - left), bottom + b * (top - bottom))));
    }
    const [code, ...others] = seen;
    if (others.length || code === null || code < 0) return "";
    const way = nearestOther(codes, columns, middle, code)?.map((pixels, i) => (pixels * stride * ([x, y][i].stop - [x, y][i].start)) / ([nx, ny][i] - 1));
    return nearestText(map.outcomes[code].label, way, [x, y]);
  }

  function tileCode(at, level) {
    const cells = 2 ** level, i = Math.floor((at.u + 0.5) * cells), j = Math.floor((at.v + 0.5) * cells);
    const values = tiles.get(`${level},${Math.floor(i / SIDE)},${Math.floor(j / SIDE)}`)?.values;
    return values ? values[(j % SIDE) * SIDE + (i % SIDE)] : null;
  }

  // Finer tiles are drawn over the hatch: what they toss has no count of trusted impacts.
  function paint(pen, at) {
    const { across, down } = at;
    const [left, right] = [across(-stride / 2), across((columns - 0.5) * stride)];
    const [bottom, top] = [down(-stride / 2), down((rows - 0.5) * stride)];
    pen.imageSmoothingEnabled = (right - left) / columns < 1;
    pen.drawImage(base, left, top, right - left, bottom - top);
    if (untrusted) drawHatch(pen, at, untrusted, [left, top, right - left, bottom - top]);
    const wanted = level();
    for (let each = 1; each <= wanted; each++) drawTiles(pen, at, each, each === wanted);
    if (grid) drawGrid(pen, at);
    if (chosen) drawCursor(pen, at, chosen, { u: 0.5 / 2 ** wanted, v: 0.5 / 2 ** wanted });
    onNearest(lookAround(at.window));
  }

  function visible(level, { left, right, bottom, top }) {
    const size = SIDE / 2 ** level, last = (count) => Math.ceil((count * 2 ** level) / SIDE) - 1;
    const part = (low, high, count) => [
      clamp(Math.floor((low + 0.5) / size), 0, last(count)), clamp(Math.floor((high + 0.5) / size), 0, last(count))];
    const [i0, i1] = part(left, right, nx), [j0, j1] = part(bottom, top, ny), found = [];
    for (let j = j0; j <= j1; j++) for (let i = i0; i <= i1; i++) found.push({ level, i, j, size });
    return found;
  }

  function drawTiles(pen, { window, across, down }, level, ask) {
    if (!ask && ![...tiles.keys()].some((key) => key.startsWith(`${level},`))) return;
    const missing = [];
    pen.imageSmoothingEnabled = false;
    for (const part of visible(level, window)) {
      const found = tiles.get(`${level},${part.i},${part.j}`);
      if (!found) missing.push(part);
      else {
        const u = part.i * part.size - 0.5, v = part.j * part.size - 0.5;
        const x0 = across(u), y0 = down(v + part.size);
        pen.drawImage(found.image, x0, y0, across(u + part.size) - x0, down(v) - y0);
      }
    }
    if (ask) {
      const { left, right, bottom, top } = window;
      const middle = ({ i, j, size }) => Math.hypot((i + 0.5) * size - (left + right) / 2, (j + 0.5) * size - (bottom + top) / 2);
      queue = missing.sort((a, b) => middle(a) - middle(b));
      fill();
    }
  }

  // One tile after the other, from the middle; a toss that is clicked comes between them.
  async function fill() {
    if (busy || failed || !queue.length) return;
    busy = true;
    const part = queue.shift();
    try {
      const values = await tile(part.level, part.i, part.j);
      const image = picture(values, SIDE, SIDE, colorsOf(map.outcomes));
      clearOutside(image, values);
      if (tiles.size >= KEPT) tiles.delete(tiles.keys().next().value);
      tiles.set(`${part.level},${part.i},${part.j}`, { values, image });
    } catch (error) {
      failed = true;
      onProblem(error.message);
    }
    busy = false;
    view.redraw();
  }

  function drawGrid(pen, { across, down }) {
    pen.strokeStyle = "#000";
    pen.fillStyle = "#fff";
    pen.lineWidth = 1;
    for (const v of grid.rows) for (const u of grid.columns) {
      pen.beginPath();
      pen.arc(across(u), down(v), 3, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
  }

  function choose(u, v, exactly = false) {
    chosen = place(u, v, exactly);
    view.reveal(chosen.u, chosen.v);
    onChoose(chosen);
  }

  function step(dx, dy) {
    if (!anywhere) {
      const next = (list, at, by) => list[clamp(list.indexOf(at) + by, 0, list.length - 1)];
      return choose(next(grid.columns, chosen.u, dx), next(grid.rows, chosen.v, dy));
    }
    const size = level() ? 2 ** -level() : stride;
    choose(clamp(chosen.u + dx * size, 0, nx - 1), clamp(chosen.v + dy * size, 0, ny - 1));
  }

  // The middle, or what both engines have tossed that is nearest to it.
  function chooseMiddle() {
    const [u, v] = [(nx - 1) / 2, (ny - 1) / 2];
    if (grid) choose(nearest(grid.columns, u), nearest(grid.rows, v), true);
    else choose(u, v);
  }

  return { zoom: view.zoom, showWhole: view.showWhole, choose, chooseMiddle };
}

function clearOutside(image, values) {
  const pen = image.getContext("2d");
  values.forEach((code, at) => {
    if (code < 0) pen.clearRect(at % SIDE, SIDE - 1 - Math.floor(at / SIDE), 1, 1);
  });
}

function bytes(text) {
  return Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
}

const nearest = (list, at) => list.reduce((best, each) => (Math.abs(each - at) < Math.abs(best - at) ? each : best));
