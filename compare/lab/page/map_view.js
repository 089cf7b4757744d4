// A map on a canvas: its window and axes; zoom by wheel, pinch and keys; panning; the cursor and the hatch.

import { ticks } from "./ticks.js";

const LEFT = 74, BOTTOM = 52, TOP = 10, RIGHT = 14;
const HATCH = 7; // between two lines over untrusted pixels
const GLIDE = 200; // [ms] that a zoom takes where one likes motion
const APART = { x: 90, y: 55 }; // between two values at an axis, at least [px]
const LONG = 9; // signs: longer values have smaller digits

export const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

// A window is { left, right, bottom, top } in the values u, v of both fields. `about` has: the canvas; axes(), of
// { x, y }, each with its word and unit; whole(), the window of all; limits(window), by what factors it may be zoomed,
// { least, most }; paint(pen, at), which draws inside of the axes; and callbacks: hover(u, v), choose(u, v),
// step(columns, rows), about() for where keys zoom, moved(), when the window changes, and end(whether), when it can be no smaller.
export function makeView(about) {
  const { canvas, axes, whole, limits, paint } = about;
  let window_ = whole(), glide = null, waiting = 0, drag = null, pinch = null;
  const touches = new Map();

  const frame = () => {
    const size = canvas.getBoundingClientRect(), height = Math.max(size.height - TOP - BOTTOM, 40);
    const left = Math.max(LEFT, 30 + widest(labels(window_.bottom, window_.top, height / APART.y)));
    return { left, top: TOP, width: Math.max(size.width - left - RIGHT, 40), height };
  };

  function placing() {
    const box = frame(), window = seen(), { left, right, bottom, top } = window;
    const across = (u) => box.left + ((u - left) / (right - left)) * box.width, down = (v) => box.top + box.height - ((v - bottom) / (top - bottom)) * box.height;
    return { box, window, across, down };
  }

  // The window that is drawn, which may be on its way to the one that is chosen: its size changes at an even rate.
  function seen() {
    const time = glide ? (performance.now() - glide.start) / GLIDE : 1;
    if (time >= 1) glide = null;
    if (!glide) return window_;
    const { from, factor } = glide, eased = 1 - (1 - time) ** 3, part = Math.abs(factor - 1) < 1e-9 ? eased : (factor ** eased - 1) / (factor - 1);
    return Object.fromEntries(Object.keys(from).map((side) => [side, from[side] + part * (window_[side] - from[side])]));
  }

  function draw() {
    waiting = 0;
    const dots = devicePixelRatio || 1, size = canvas.getBoundingClientRect();
    if (!size.width || !size.height) return;
    const wide = Math.round(size.width * dots), high = Math.round(size.height * dots);
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
    const pen = canvas.getContext("2d"), at = placing(), { box } = at;
    pen.setTransform(dots, 0, 0, dots, 0, 0);
    pen.clearRect(0, 0, size.width, size.height);
    pen.save();
    pen.beginPath();
    pen.rect(box.left, box.top, box.width, box.height);
    pen.clip();
    paint(pen, at);
    pen.restore();
    drawAxes(pen, at, axes());
    if (glide) redraw();
  }

  const redraw = () => (waiting ||= requestAnimationFrame(draw));

  function show(window, glides = false) {
    const from = seen(), isGliding = glides && !matchMedia("(prefers-reduced-motion: reduce)").matches;
    window_ = window;
    glide = isGliding ? { from, factor: (window_.right - window_.left) / (from.right - from.left), start: performance.now() } : null;
    redraw();
    about.moved();
  }

  const moved = (from, du, dv) => ({ left: from.left + du, right: from.right + du, bottom: from.bottom + dv, top: from.top + dv });

  function zoom(factor, u = (window_.left + window_.right) / 2, v = (window_.bottom + window_.top) / 2, glides = true) {
    const { left, right, bottom, top } = window_, { least, most } = limits(window_);
    const size = clamp(factor, Math.min(least, 1), Math.max(most, 1));
    about.end(factor < size);
    show({ left: u + (left - u) * size, right: u + (right - u) * size, bottom: v + (bottom - v) * size, top: v + (top - v) * size }, glides);
  }

  const showWhole = () => (about.end(false), show(whole(), true));

  // The window goes along where a point is outside of it.
  function reveal(u, v) {
    const { left, right, bottom, top } = window_;
    if (u < left || u > right || v < bottom || v > top) show(moved(window_, u - (left + right) / 2, v - (bottom + top) / 2));
    else redraw();
  }

  function under(event) {
    const size = canvas.getBoundingClientRect(), box = frame();
    const px = event.clientX - size.left - box.left, py = event.clientY - size.top - box.top;
    const { left, right, bottom, top } = seen();
    const inside = px >= 0 && py >= 0 && px <= box.width && py <= box.height;
    return { inside, u: left + (px / box.width) * (right - left), v: top - (py / box.height) * (top - bottom) };
  }

  // Two fingers: the points below them stay there.
  function pinched() {
    const [a, b] = touches.values(), spread = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    const middle = { clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 };
    if (pinch) {
      const from = under(pinch.middle), to = under(middle);
      window_ = moved(window_, from.u - to.u, from.v - to.v);
      if (spread > 0 && pinch.spread > 0) zoom(pinch.spread / spread, from.u, from.v, false);
    }
    pinch = { spread, middle };
  }

  canvas.addEventListener("wheel", (event) => {
    const at = under(event);
    if (!at.inside) return;
    event.preventDefault();
    zoom(Math.exp(clamp(event.deltaY, -120, 120) / 300), at.u, at.v);
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "touch") touches.set(event.pointerId, event);
    if (touches.size === 2) pinched();
    if (event.button === 0) drag = { x: event.clientX, y: event.clientY, window: window_, moved: touches.size > 1 };
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = under(event), box = frame();
    if (touches.has(event.pointerId)) {
      touches.set(event.pointerId, event);
      if (touches.size === 2) pinched();
    } else if (drag && event.buttons) {
      const dx = event.clientX - drag.x, dy = event.clientY - drag.y, { left, right, bottom, top } = drag.window;
      drag.moved ||= Math.hypot(dx, dy) > 4;
      if (drag.moved) show(moved(drag.window, (-dx / box.width) * (right - left), (dy / box.height) * (top - bottom)));
    } else if (at.inside) about.hover(at.u, at.v);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, ({ pointerId }) => (touches.delete(pointerId), (pinch = null)));
  canvas.addEventListener("click", (event) => {
    const at = under(event), was = drag?.moved;
    drag = null;
    if (!was && at.inside) about.choose(at.u, at.v);
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const by = event.shiftKey ? 10 : 1, { u, v } = about.about() ?? {};
    const actions = {
      ArrowLeft: () => about.step(-by, 0), ArrowRight: () => about.step(by, 0), ArrowUp: () => about.step(0, by), ArrowDown: () => about.step(0, -by),
      "+": () => zoom(0.5, u, v), "=": () => zoom(0.5, u, v), "-": () => zoom(2, u, v), 0: showWhole, Enter: () => about.step(0, 0),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
  new ResizeObserver(redraw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  redraw();
  return { redraw, show, reveal, frame, window: () => window_, zoom: (factor) => zoom(factor, about.about()?.u, about.about()?.v), showWhole };
}

function drawAxes(pen, { box, window, across, down }, { x, y }) {
  const family = getComputedStyle(document.body).fontFamily, foot = box.top + box.height;
  const marks = (apart) => labels(window.left, window.right, box.width / apart), up = labels(window.bottom, window.top, box.height / APART.y);
  const along = marks(Math.max(APART.x, widest(marks(APART.x)) + 12));
  const write = (text, font, at, down, most, textAlign = "center", textBaseline = "top") => {
    Object.assign(pen, { font: `${font} ${family}`, textAlign, textBaseline });
    pen.fillText(text, at, down, most);
  };
  Object.assign(pen, { strokeStyle: style("--soft"), lineWidth: 1, fillStyle: style("--ink") });
  pen.strokeRect(box.left - 0.5, box.top - 0.5, box.width + 1, box.height + 1);
  for (const { value, text } of along) {
    pen.strokeRect(across(value), foot, 0, 6);
    write(text, `${digits(along)}px`, across(value), foot + 9, box.width);
  }
  for (const { value, text } of up) {
    pen.strokeRect(box.left - 6, down(value), 6, 0);
    write(text, `${digits(up)}px`, box.left - 9, down(value), box.left - 30, "right", "middle");
  }
  write(title(x), "600 15px", box.left + box.width / 2, foot + 31, box.width + LEFT);
  pen.save();
  pen.translate(11, box.top + box.height / 2);
  pen.rotate(-Math.PI / 2);
  write(title(y), "600 15px", 0, 0, box.height + BOTTOM, "center", "middle");
  pen.restore();
}

// An axis's ticks with their texts: plain numbers, with as many digits as it takes.
const labels = (low, high, most) => ticks(low, high, most).values.map((value) => ({ value, text: String(value) }));
const title = ({ word, unit }) => (unit ? `${word} [${unit}]` : word);
const longest = (marks) => Math.max(0, ...marks.map(({ text }) => text.length));
const digits = (marks) => (longest(marks) > LONG ? 12 : 15);
const widest = (marks) => 0.6 * digits(marks) * longest(marks);

// A tint and lines over the pixels of a mask that is stretched over a place, [left, top, width, height].
export function drawHatch(pen, { box }, image, place) {
  const layer = document.createElement("canvas"), lines = layer.getContext("2d");
  layer.width = pen.canvas.width;
  layer.height = pen.canvas.height;
  lines.setTransform(pen.getTransform());
  lines.imageSmoothingEnabled = false;
  lines.drawImage(image, ...place);
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
  pen.drawImage(image, ...place);
  pen.globalAlpha = 1;
  pen.save();
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.drawImage(layer, 0, 0);
  pen.restore();
}

// A cross about a pixel whose half sizes are given in the values of both fields.
export function drawCursor(pen, { box, window, across, down }, { u, v }, half) {
  const wide = Math.max((half.u * box.width) / (window.right - window.left), 5), high = Math.max((half.v * box.height) / (window.top - window.bottom), 5);
  const cx = across(u), cy = down(v);
  stroked(pen, [["#fff", 5], [style("--cursor"), 3]], () => {
    pen.rect(cx - wide, cy - high, 2 * wide, 2 * high);
    for (const [dx, dy, reach] of [[1, 0, wide], [-1, 0, wide], [0, 1, high], [0, -1, high]]) {
      pen.moveTo(cx + dx * (reach + 2), cy + dy * (reach + 2));
      pen.lineTo(cx + dx * (reach + 14), cy + dy * (reach + 14));
    }
  });
}

// Draws what `trace` traces with each [color, width, dashes] in turn.
export function stroked(pen, pens, trace) {
  for (const [strokeStyle, lineWidth, dashes = []] of pens) {
    Object.assign(pen, { strokeStyle, lineWidth });
    pen.setLineDash(dashes);
    pen.beginPath();
    trace();
    pen.stroke();
  }
  pen.setLineDash([]);
}
