// The map on its canvas: pixels, axes, zoom, the cursor, and finer tiles where one zooms past the pixels.

import { title, valueAt, indexOf, shown } from "./axes.js";
import { ticks } from "./ticks.js";

const LEFT = 74, BOTTOM = 52, TOP = 10, RIGHT = 14;
const SIDE = 32; // of a tile, in its own pixels
const FINEST = 30;
const COARSE = 9; // a pixel larger than so many on the screen is cut finer
const KEPT = 400; // tiles
const HATCH = 7; // between two lines over untrusted pixels

export function makeMap({ canvas, map, grid, anywhere, tile, onHover, onChoose, onProblem }) {
  const { x, y } = map.axes, nx = x.count, ny = y.count;
  const codes = Int8Array.from(bytes(map.arrays.outcome));
  const stride = map.stride, columns = Math.ceil(nx / stride), rows = Math.ceil(ny / stride);
  const whole = () => ({ left: -stride / 2, right: (columns - 0.5) * stride, bottom: -stride / 2, top: (rows - 0.5) * stride });
  let view = whole(), chosen = null, drag = null, waiting = 0;
  const tiles = new Map();
  let queue = [], busy = false, failed = false;

  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const colors = () => ({ "-1": style("--untossed"), ...Object.fromEntries(Object.entries(map.outcomes).map(([code, { color }]) => [code, color])) });

  function picture(values, width, height) {
    const image = document.createElement("canvas");
    image.width = width;
    image.height = height;
    const pen = image.getContext("2d"), pixels = pen.createImageData(width, height), rgb = {};
    for (const [code, color] of Object.entries(colors())) rgb[code] = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
    for (let row = 0; row < height; row++) {
      for (let column = 0; column < width; column++) {
        const at = 4 * ((height - 1 - row) * width + column), color = rgb[values[row * width + column]] ?? rgb["-1"];
        pixels.data.set([...color, 255], at);
      }
    }
    pen.putImageData(pixels, 0, 0);
    return image;
  }

  let base = picture(codes, columns, rows);
  const untrusted = map.arrays.untrusted ? mask(Int8Array.from(bytes(map.arrays.untrusted)), columns, rows) : null;

  const frame = () => {
    const { width, height } = canvas.getBoundingClientRect();
    return { left: LEFT, top: TOP, width: Math.max(width - LEFT - RIGHT, 40), height: Math.max(height - TOP - BOTTOM, 40) };
  };
  const across = (u, box) => box.left + ((u - view.left) / (view.right - view.left)) * box.width;
  const down = (v, box) => box.top + box.height - ((v - view.bottom) / (view.top - view.bottom)) * box.height;

  // The level at which the pixels on the screen are small enough; 0 for the map's own, as long as one is not past them.
  function level(box) {
    if (!tile) return 0;
    const size = (part) => stride * Math.max(box.width / (part.right - part.left), box.height / (part.top - part.bottom));
    const now = size(view);
    return now <= Math.max(COARSE, 1.5 * size(whole())) ? 0 : clamp(Math.ceil(Math.log2(now / stride / COARSE)), 1, FINEST);
  }

  // The nearest pixel, of the finer map where it is shown, or that can be tossed.
  function snapped(u, v) {
    if (!anywhere) return { u: nearest(grid.columns, u), v: nearest(grid.rows, v) };
    const cells = 2 ** level(frame());
    const cell = (at, count) => clamp((Math.floor((at + 0.5) * cells) + 0.5) / cells - 0.5, 0, count - 1);
    const coarse = (at, count) => clamp(Math.round(at / stride) * stride, 0, count - 1);
    return cells === 1 ? { u: coarse(u, nx), v: coarse(v, ny) } : { u: cell(u, nx), v: cell(v, ny) };
  }

  function place(u, v, exactly = false) {
    const at = exactly && anywhere ? { u, v } : snapped(u, v), box = frame(), column = Math.round(at.u / stride), row = Math.round(at.v / stride);
    const isPixel = Number.isInteger(at.u / stride) && Number.isInteger(at.v / stride);
    const index = row * columns + column, found = isPixel ? codes[index] : tileCode(at, level(box));
    return { ...at, x: valueAt(x, at.u), y: valueAt(y, at.v), code: found, index: isPixel ? index : null, step: 2 ** -level(box) * stride };
  }

  function tileCode(at, level) {
    const cells = 2 ** level, i = Math.floor((at.u + 0.5) * cells), j = Math.floor((at.v + 0.5) * cells);
    const values = tiles.get(`${level},${Math.floor(i / SIDE)},${Math.floor(j / SIDE)}`)?.values;
    return values ? values[(j % SIDE) * SIDE + (i % SIDE)] : null;
  }

  function draw() {
    waiting = 0;
    const dots = window.devicePixelRatio || 1, size = canvas.getBoundingClientRect();
    canvas.width = Math.round(size.width * dots);
    canvas.height = Math.round(size.height * dots);
    const pen = canvas.getContext("2d"), box = frame();
    pen.scale(dots, dots);
    pen.clearRect(0, 0, size.width, size.height);
    pen.save();
    pen.beginPath();
    pen.rect(box.left, box.top, box.width, box.height);
    pen.clip();
    const [left, right] = [across(-stride / 2, box), across((columns - 0.5) * stride, box)];
    const [bottom, top] = [down(-stride / 2, box), down((rows - 0.5) * stride, box)];
    pen.imageSmoothingEnabled = (right - left) / columns < 1;
    pen.drawImage(base, left, top, right - left, bottom - top);
    if (untrusted) drawHatch(pen, box, [left, top, right - left, bottom - top]);
    const wanted = level(box);
    for (let each = 1; each <= wanted; each++) drawTiles(pen, box, each, each === wanted);
    if (grid) drawGrid(pen, box);
    if (chosen) drawCursor(pen, box, wanted);
    pen.restore();
    drawAxes(pen, box);
  }

  // A tint and lines over the untrusted pixels. Finer tiles are drawn over both: what they toss has no count.
  function drawHatch(pen, box, place) {
    const layer = document.createElement("canvas"), lines = layer.getContext("2d");
    layer.width = canvas.width;
    layer.height = canvas.height;
    lines.setTransform(pen.getTransform());
    lines.imageSmoothingEnabled = false;
    lines.drawImage(untrusted, ...place);
    lines.globalCompositeOperation = "source-in";
    lines.strokeStyle = "#fff";
    lines.lineWidth = 1.5;
    lines.beginPath();
    for (let from = box.left - box.height; from < box.left + box.width; from += HATCH) {
      lines.moveTo(from, box.top + box.height);
      lines.lineTo(from + box.height, box.top);
    }
    lines.stroke();
    pen.globalAlpha = 0.3;
    pen.drawImage(untrusted, ...place);
    pen.globalAlpha = 1;
    pen.save();
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(layer, 0, 0);
    pen.restore();
  }

  function visible(level) {
    const size = SIDE / 2 ** level, last = (count) => Math.ceil((count * 2 ** level) / SIDE) - 1;
    const part = (low, high, count) => [
      clamp(Math.floor((low + 0.5) / size), 0, last(count)), clamp(Math.floor((high + 0.5) / size), 0, last(count))];
    const [i0, i1] = part(view.left, view.right, nx), [j0, j1] = part(view.bottom, view.top, ny), found = [];
    for (let j = j0; j <= j1; j++) for (let i = i0; i <= i1; i++) found.push({ level, i, j, size });
    return found;
  }

  function drawTiles(pen, box, level, ask) {
    if (!ask && ![...tiles.keys()].some((key) => key.startsWith(`${level},`))) return;
    const missing = [];
    pen.imageSmoothingEnabled = false;
    for (const part of visible(level)) {
      const found = tiles.get(`${level},${part.i},${part.j}`);
      if (!found) missing.push(part);
      else {
        const u = part.i * part.size - 0.5, v = part.j * part.size - 0.5;
        const x0 = across(u, box), y0 = down(v + part.size, box);
        pen.drawImage(found.image, x0, y0, across(u + part.size, box) - x0, down(v, box) - y0);
      }
    }
    if (ask) {
      const middle = ({ i, j, size }) => Math.hypot((i + 0.5) * size - (view.left + view.right) / 2, (j + 0.5) * size - (view.bottom + view.top) / 2);
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
      const image = picture(values, SIDE, SIDE);
      clearOutside(image, values);
      if (tiles.size >= KEPT) tiles.delete(tiles.keys().next().value);
      tiles.set(`${part.level},${part.i},${part.j}`, { values, image });
    } catch (error) {
      failed = true;
      onProblem(error.message);
    }
    busy = false;
    redraw();
  }

  function drawGrid(pen, box) {
    pen.strokeStyle = "#000";
    pen.fillStyle = "#fff";
    pen.lineWidth = 1;
    for (const v of grid.rows) for (const u of grid.columns) {
      pen.beginPath();
      pen.arc(across(u, box), down(v, box), 3, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
  }

  function drawCursor(pen, box, level) {
    const half = Math.max((0.5 * box.width) / (view.right - view.left) / 2 ** level, 5);
    const high = Math.max((0.5 * box.height) / (view.top - view.bottom) / 2 ** level, 5);
    const cx = across(chosen.u, box), cy = down(chosen.v, box);
    for (const [color, width] of [["#fff", 5], [style("--cursor"), 3]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.strokeRect(cx - half, cy - high, 2 * half, 2 * high);
      pen.beginPath();
      for (const [dx, dy, reach] of [[1, 0, half], [-1, 0, half], [0, 1, high], [0, -1, high]]) {
        pen.moveTo(cx + dx * (reach + 2), cy + dy * (reach + 2));
        pen.lineTo(cx + dx * (reach + 14), cy + dy * (reach + 14));
      }
      pen.stroke();
    }
  }

  function drawAxes(pen, box) {
    const ink = style("--ink");
    pen.strokeStyle = style("--soft");
    pen.lineWidth = 1;
    pen.strokeRect(box.left - 0.5, box.top - 0.5, box.width + 1, box.height + 1);
    pen.fillStyle = ink;
    pen.font = `15px ${getComputedStyle(document.body).fontFamily}`;
    pen.textAlign = "center";
    pen.textBaseline = "top";
    const values = (axis, low, high) => [low, high].map((at) => axis.start + at * ((axis.stop - axis.start) / (axis.count - 1)));
    const along = ticks(...values(x, view.left, view.right), box.width / 90), up = ticks(...values(y, view.bottom, view.top), box.height / 55);
    for (const value of along.values) {
      const at = across(indexOf(x, value), box);
      pen.strokeRect(at, box.top + box.height, 0, 6);
      pen.fillText(shown(value, along.step), at, box.top + box.height + 9);
    }
    pen.font = `600 15px ${getComputedStyle(document.body).fontFamily}`;
    pen.fillText(title(x), box.left + box.width / 2, box.top + box.height + 31, box.width + LEFT);
    pen.font = `15px ${getComputedStyle(document.body).fontFamily}`;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const value of up.values) {
      const at = down(indexOf(y, value), box);
      pen.strokeRect(box.left - 6, at, 6, 0);
      pen.fillText(shown(value, up.step), box.left - 9, at, LEFT - 30);
    }
    pen.save();
    pen.translate(11, box.top + box.height / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "center";
    pen.font = `600 15px ${getComputedStyle(document.body).fontFamily}`;
    pen.fillText(title(y), 0, 0, box.height + BOTTOM);
    pen.restore();
  }

  function redraw() {
    if (!waiting) waiting = requestAnimationFrame(draw);
  }

  function zoom(factor, u = (view.left + view.right) / 2, v = (view.bottom + view.top) / 2) {
    const size = clamp((view.right - view.left) * factor, 16 / 2 ** (tile ? 28 : 2), 2 * nx) / (view.right - view.left);
    view = {
      left: u + (view.left - u) * size, right: u + (view.right - u) * size,
      bottom: v + (view.bottom - v) * size, top: v + (view.top - v) * size,
    };
    kept();
  }

  // The middle of the view stays on the map.
  function kept() {
    const by = (low, high, count) => clamp((low + high) / 2, -0.5, count - 0.5) - (low + high) / 2;
    const dx = by(view.left, view.right, nx), dy = by(view.bottom, view.top, ny);
    view = { left: view.left + dx, right: view.right + dx, bottom: view.bottom + dy, top: view.top + dy };
    redraw();
  }

  function under(event) {
    const size = canvas.getBoundingClientRect(), box = frame();
    const px = event.clientX - size.left - box.left, py = event.clientY - size.top - box.top;
    const inside = px >= 0 && py >= 0 && px <= box.width && py <= box.height;
    return {
      inside, u: view.left + (px / box.width) * (view.right - view.left), v: view.top - (py / box.height) * (view.top - view.bottom),
    };
  }

  function choose(u, v, exactly = false) {
    chosen = place(u, v, exactly);
    if (chosen.u < view.left || chosen.u > view.right || chosen.v < view.bottom || chosen.v > view.top) {
      const dx = chosen.u - (view.left + view.right) / 2, dy = chosen.v - (view.bottom + view.top) / 2;
      view = { left: view.left + dx, right: view.right + dx, bottom: view.bottom + dy, top: view.top + dy };
    }
    redraw();
    onChoose(chosen);
  }

  function step(dx, dy) {
    if (!chosen) return choose((view.left + view.right) / 2, (view.bottom + view.top) / 2);
    if (!anywhere) {
      const next = (list, at, by) => list[clamp(list.indexOf(at) + by, 0, list.length - 1)];
      return choose(next(grid.columns, chosen.u, dx), next(grid.rows, chosen.v, dy));
    }
    const size = level(frame()) ? 2 ** -level(frame()) : stride;
    choose(clamp(chosen.u + dx * size, 0, nx - 1), clamp(chosen.v + dy * size, 0, ny - 1));
  }

  canvas.addEventListener("wheel", (event) => {
    const at = under(event);
    if (!at.inside) return;
    event.preventDefault();
    zoom(Math.exp(clamp(event.deltaY, -120, 120) / 300), at.u, at.v);
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button === 0) drag = { x: event.clientX, y: event.clientY, view, moved: false };
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = under(event), box = frame();
    if (drag && event.pointerType !== "touch" && event.buttons) {
      const dx = event.clientX - drag.x, dy = event.clientY - drag.y;
      drag.moved ||= Math.hypot(dx, dy) > 4;
      if (drag.moved) {
        const du = (-dx / box.width) * (view.right - view.left), dv = (dy / box.height) * (view.top - view.bottom);
        view = { left: drag.view.left + du, right: drag.view.right + du, bottom: drag.view.bottom + dv, top: drag.view.top + dv };
        kept();
      }
    } else if (at.inside) onHover(place(at.u, at.v));
  });
  canvas.addEventListener("click", (event) => {
    const at = under(event), moved = drag?.moved;
    drag = null;
    if (!moved && at.inside) choose(at.u, at.v);
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const by = event.shiftKey ? 10 : 1;
    const actions = {
      ArrowLeft: () => step(-by, 0), ArrowRight: () => step(by, 0), ArrowUp: () => step(0, by), ArrowDown: () => step(0, -by),
      "+": () => zoom(0.5, chosen?.u, chosen?.v), "=": () => zoom(0.5, chosen?.u, chosen?.v), "-": () => zoom(2, chosen?.u, chosen?.v),
      0: () => { view = whole(); redraw(); }, Enter: () => step(0, 0),
    };
    if (actions[event.key]) {
      event.preventDefault();
      actions[event.key]();
    }
  });
  new ResizeObserver(redraw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    base = picture(codes, columns, rows);
    redraw();
  });
  redraw();
  return { zoom: (factor) => zoom(factor, chosen?.u, chosen?.v), showWhole() { view = whole(); redraw(); }, choose };
}

// White where a value is 1, else transparent.
function mask(values, width, height) {
  const image = document.createElement("canvas");
  image.width = width;
  image.height = height;
  const pen = image.getContext("2d"), pixels = pen.createImageData(width, height);
  values.forEach((value, at) => {
    const start = 4 * ((height - 1 - Math.floor(at / width)) * width + (at % width));
    pixels.data.fill(255 * value, start, start + 4);
  });
  pen.putImageData(pixels, 0, 0);
  return image;
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

export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

const nearest = (list, at) => list.reduce((best, each) => (Math.abs(each - at) < Math.abs(best - at) ? each : best));
