// A plot over time as SVG: the values at the pointer, zoom by dragging, and a line at the time that is played.

import { element, shape } from "./elements.js";
import { placeIn, valueAt } from "./sampled.js";
import { makeTimeline, proofText } from "./timeline.js";
import { logTicks, ticks } from "./ticks.js";

const LEFT = 66, RIGHT = 14, TOP = 26, BOTTOM = 48;
const SHORTEST = 1e-6; // of the whole time
const CLEAR_MARKS = 40; // more vertical lines than these fade
const MOST_DOTS = 300;
const APART = 45, HIGH = 22, LETTER = 9; // between times at the axis, values of a logarithmic one, and letters [px]

export function numberText(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(1).replace(".0e", "e") : String(Number(value.toPrecision(5)));
}

// The stretch of time that several plots of tosses show, and the times that are marked in all of them; `pick` is called
// with a time that is clicked. Its ends are places on the axis of timeline.js, and so is what changes them.
export function makeSpan(tosses) {
  const axis = makeTimeline(tosses), { end } = axis, plots = [];
  const span = { axis, end, low: 0, high: end, pointed: null, played: null, pick: () => {}, add: (plot) => plots.push(plot) };
  const all = (how) => plots.forEach((plot) => plot[how]());
  span.show = (low, high) => {
    const wide = Math.min(Math.max(high - low, SHORTEST * end), end);
    span.low = Math.min(Math.max((low + high - wide) / 2, 0), end - wide);
    span.high = span.low + wide;
    all("draw");
  };
  span.zoom = (factor) => {
    const about = span.pointed === null ? (span.low + span.high) / 2 : axis.placeOf(span.pointed);
    span.show(about + factor * (span.low - about), about + factor * (span.high - about));
  };
  span.point = (time) => {
    span.pointed = time === null ? null : Math.min(Math.max(time, axis.timeAt(span.low)), axis.timeAt(span.high));
    all("mark");
  };
  span.play = (time) => {
    span.played = time;
    all("mark");
  };
  return span;
}

// Puts a plot into a box. `about` has: title, unit, lines of { name, kind, time, values }; and optionally
// height, log, range (both ends, or from which value on), at (ticks of [value, text]), levels of { value, text },
// dots of { kind, time, values }, marks (times), and bars of { time, text } and optionally kind.
export function makePlot(box, about, span) {
  const { title, unit = "", lines, height = 290, levels = [], dots = [], marks = [], bars = [] } = about;
  const svg = shape("svg", { role: "img", tabindex: "0", height, "aria-label": label(about) });
  const readout = element("p", "values"), drawn = shape("g"), marked = shape("g");
  svg.append(drawn, marked);
  box.classList.add("plot");
  box.replaceChildren(readout, svg);
  let wide = 0, low = 0, high = 1, drag = null;

  const { axis } = span;
  const xOf = (place) => LEFT + ((place - span.low) / (span.high - span.low)) * (wide - LEFT - RIGHT);
  const x = (time) => xOf(axis.placeOf(time));
  const placeAt = (x) => span.low + ((x - LEFT) / (wide - LEFT - RIGHT)) * (span.high - span.low);
  const y = (value) => {
    const part = about.log ? Math.log(Math.max(value, low) / low) / Math.log(high / low) : (value - low) / (high - low);
    return height - BOTTOM - part * (height - TOP - BOTTOM);
  };
  const upright = (kind, time) => shape("line", { class: kind, x1: x(time), x2: x(time), y1: TOP, y2: height - BOTTOM });
  const visible = (time) => axis.placeOf(time) >= span.low && axis.placeOf(time) <= span.high;

  // The samples of a line that are in sight, and one more on each side.
  function inSight({ time, values }) {
    const first = placeIn(time, axis.timeAt(span.low)).at, last = placeIn(time, axis.timeAt(span.high)).at + 2;
    return { time: time.slice(first, last), values: values.slice(first, last) };
  }

  // Round times, as many on each scale as have room.
  function times() {
    const room = Math.min(6, wide / 100) / (span.high - span.low), isBent = span.low < axis.bend && axis.bend < span.high;
    const parts = isBent ? [[span.low, axis.bend], [axis.bend, span.high]] : [[span.low, span.high]];
    const found = parts.flatMap(([low, high]) => ticks(axis.timeAt(low), axis.timeAt(high), Math.max(room * (high - low), 3)).values);
    return found.reduce((kept, time) => (kept.length && x(time) - x(kept.at(-1)) < APART ? kept : [...kept, time]), []);
  }

  // The part whose scale is another is shaded, and its begin is cut.
  function squeezed(foot) {
    const from = Math.max(xOf(axis.bend), LEFT), to = wide - RIGHT;
    if (from >= to) return [];
    const cut = from > LEFT ? [shape("path", { class: "cut", d: `M${from - 5} ${foot + 6}l5 -12m3 12l5 -12` })] : [];
    return [shape("rect", { class: "squeezed", x: from, y: TOP, width: to - from, height: foot - TOP }), ...cut];
  }

  function scale(parts) {
    if (about.range?.length === 2) return ([low, high] = about.range);
    const all = parts.flatMap(({ values }) => values);
    let [least, most] = all.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], all.length ? [Infinity, -Infinity] : [0, 1]);
    if (about.log) {
      for (const { value } of levels) [least, most] = [Math.min(Math.max(least, value / 20), value), Math.max(most, value)];
      return ([low, high] = [least / 1.3, most * 1.3]);
    }
    if (about.range) least = Math.min(least, about.range[0]);
    const edge = 0.05 * (most - least) || 0.05 * Math.abs(most) || 1;
    return ([low, high] = [about.range ? about.range[0] : least - edge, most + edge]);
  }

  function draw() {
    wide = box.clientWidth;
    if (!wide) return;
    svg.setAttribute("width", wide);
    const right = wide - RIGHT, foot = height - BOTTOM, parts = lines.map(inSight), made = [], named = [];
    scale(parts);
    const frame = shape("svg", { x: LEFT, y: TOP, width: right - LEFT, height: foot - TOP, viewBox: `${LEFT} ${TOP} ${right - LEFT} ${foot - TOP}` });
    const rows = about.at ?? (about.log ? logTicks(low, high, Math.min((height - TOP - BOTTOM) / HIGH, 7)) : ticks(low, high, 5).values).map((value) => [value, numberText(value)]);
    const level = (kind, value) => shape("line", { class: kind, x1: LEFT, x2: right, y1: y(value), y2: y(value) });
    for (const [value, text] of rows) made.push(level("grid", value), shape("text", { x: LEFT - 7, y: y(value) + 5, "text-anchor": "end" }, text));
    made.push(...squeezed(foot), ...times().map((time) => shape("text", { x: x(time), y: foot + 20, "text-anchor": "middle" }, String(time))));
    made.push(shape("text", { x: right, y: height - 5, "text-anchor": "end" }, span.high > axis.bend ? "t [s], shaded: on a scale of its own" : "t [s]"));
    const near = marks.filter(visible);
    if (near.length) {
      const all = near.map((time) => `M${x(time).toFixed(1)} ${TOP}V${foot}`).join("");
      frame.append(shape("path", { class: "marks", d: all, opacity: Math.min(1, CLEAR_MARKS / near.length) }));
    }
    frame.append(...levels.map(({ value }) => level("level", value)));
    named.push(...levels.map(({ value, text }) => shape("text", { x: LEFT + 5, y: y(value) - 5 }, text)));
    lines.forEach(({ kind }, i) => {
      const { time, values } = parts[i];
      const points = time.map((each, k) => `${x(each).toFixed(1)},${y(values[k]).toFixed(1)}`);
      frame.append(shape("polyline", { class: `line ${kind}`, points: points.join(" ") }));
    });
    for (const { kind, time, values } of dots) {
      const shown = time.map((each, k) => [each, values[k]]).filter(([each]) => visible(each));
      if (shown.length > MOST_DOTS) continue;
      for (const [each, value] of shown) frame.append(shape("circle", { class: kind, cx: x(each), cy: y(value), r: 2.8 }));
    }
    for (const { time, text, kind = "" } of bars.filter((bar) => visible(bar.time))) {
      frame.append(upright(`bar ${kind}`, time));
      made.push(shape("text", { class: "bar", x: Math.min(Math.max(x(time), LEFT + 30), right - 30), y: TOP - 6, "text-anchor": "middle" }, text));
    }
    frame.append(...axis.proofs.filter((proof) => visible(proof.time)).map(({ engine, time }) => upright(`proof ${engine}`, time)));
    const proofs = axis.proofs.map(({ time }) => time).filter(visible).map(x);
    if (proofs.length) {
      const text = proofText(axis.proofs), room = LETTER * text.length, isLeft = proofs[0] - LEFT > right - proofs.at(-1);
      const at = isLeft ? Math.max(proofs[0] - 7, LEFT + room) : Math.min(proofs.at(-1) + 7, right - room);
      named.push(shape("text", { x: at, y: TOP + 17, "text-anchor": isLeft ? "end" : "start" }, text));
    }
    frame.append(...named);
    drawn.replaceChildren(...made, frame);
    mark();
  }

  function mark() {
    const made = [], foot = height - BOTTOM;
    if (drag && drag.to !== drag.from) {
      const [from, to] = [drag.from, drag.to].sort((a, b) => a - b);
      made.push(shape("rect", { class: "chosen", x: from, y: TOP, width: to - from, height: foot - TOP }));
    }
    if (span.played !== null && visible(span.played)) made.push(upright("now", span.played));
    if (span.pointed !== null) {
      made.push(upright("pointed", span.pointed));
      for (const { kind, time, values } of lines) {
        const value = valueAt(time, values, span.pointed);
        if (value !== null && value <= high) made.push(shape("circle", { class: kind, cx: x(span.pointed), cy: y(value), r: 4 }));
      }
    }
    marked.replaceChildren(...made);
    tell();
  }

  // The lines by name, with their values where the pointer is.
  function tell() {
    const at = span.pointed, parts = lines.map(({ name, kind, time, values }) => {
      const part = element("span", `of ${kind}`);
      part.append(shape("svg", { width: 22, height: 8, "aria-hidden": "true" }), name);
      part.firstChild.append(shape("path", { class: `line ${kind}`, d: "M0 4H22" }));
      if (at !== null) part.append(` ${numberText(valueAt(time, values, at))}`);
      return part;
    });
    const heading = element("b", "", unit ? `${title} [${unit}]` : title);
    readout.replaceChildren(heading, ...parts, element("span", "", at === null ? "" : `at ${Number(at.toPrecision(6))} s`));
  }

  const placed = (event) => Math.min(Math.max(event.clientX - svg.getBoundingClientRect().left, LEFT), wide - RIGHT);
  svg.addEventListener("pointermove", (event) => {
    if (drag) drag.to = placed(event);
    span.point(axis.timeAt(placeAt(placed(event))));
  });
  svg.addEventListener("pointerleave", () => drag || span.point(null));
  svg.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    drag = { from: placed(event), to: placed(event) };
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener("pointerup", () => {
    const ends = drag && [drag.from, drag.to].map(placeAt).sort((a, b) => a - b);
    const far = drag && Math.abs(drag.to - drag.from) > 6;
    drag = null;
    if (far) span.show(...ends);
    else if (ends) span.pick(axis.timeAt(ends[0]));
  });
  svg.addEventListener("pointercancel", () => {
    drag = null;
    span.point(null);
  });
  svg.addEventListener("dblclick", () => span.show(0, span.end));
  svg.addEventListener("keydown", (event) => {
    const step = ((span.high - span.low) / 100) * (event.shiftKey ? 10 : 1);
    const from = span.pointed ?? axis.timeAt((span.low + span.high) / 2), stepped = (by) => span.point(axis.timeAt(axis.placeOf(from) + by));
    const done = {
      ArrowLeft: () => stepped(-step), ArrowRight: () => stepped(step),
      "+": () => span.zoom(0.5), "-": () => span.zoom(2), 0: () => span.show(0, span.end), Escape: () => span.point(null), Enter: () => span.pick(from),
    }[event.key];
    if (!done || event.ctrlKey || event.metaKey || event.altKey) return;
    readout.setAttribute("aria-live", "polite");
    event.preventDefault();
    done();
  });
  svg.addEventListener("blur", () => readout.removeAttribute("aria-live"));
  new ResizeObserver(() => box.clientWidth !== wide && draw()).observe(box);
  span.add({ draw, mark });
  draw();
}

function label({ title, unit = "", lines, levels = [] }) {
  const ends = lines.map(({ name, values }) => `${name} from ${numberText(values[0])} to ${numberText(values.at(-1))} ${unit}`.trim());
  return [`${title} over time: ${ends.join("; ")}`, ...levels.map(({ value, text }) => `${text}: ${numberText(value)} ${unit}`.trim())].join("; ");
}
