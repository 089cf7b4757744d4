// Energy over time of both tosses, on a logarithmic scale, with the least energy to turn over.

const WIDE = 640, HIGH = 230, LEFT = 56, RIGHT = 12, TOP = 10, BOTTOM = 40;

function element(tag, attributes, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

export function showEnergy(box, tosses) {
  const there = tosses.filter((toss) => toss?.path);
  if (!there.length) {
    box.replaceChildren();
    return () => {};
  }
  const barrier = 1e3 * there[0].coin.barrier, until = Math.max(...there.map((toss) => toss.end_time));
  const values = there.flatMap((toss) => toss.path.energy.map((value) => 1e3 * value)).filter((value) => value > 0);
  const low = Math.min(barrier, Math.max(values.reduce((a, b) => Math.min(a, b)), barrier / 20)) / 1.3;
  const high = 1.2 * values.reduce((a, b) => Math.max(a, b), barrier);
  const x = (time) => LEFT + (time / (until || 1)) * (WIDE - LEFT - RIGHT);
  const y = (value) => HIGH - BOTTOM - (Math.log(Math.max(value, low) / low) / Math.log(high / low)) * (HIGH - TOP - BOTTOM);

  const svg = element("svg", { viewBox: `0 0 ${WIDE} ${HIGH}`, role: "img" });
  const last = there.map((toss) => `${toss.engine} from ${(1e3 * toss.path.energy[0]).toPrecision(3)} to ${(1e3 * toss.path.energy.at(-1)).toPrecision(3)} mJ`);
  svg.setAttribute("aria-label", `Energy over time: ${last.join("; ")}; least energy to turn over ${barrier.toPrecision(3)} mJ`);
  for (const value of levels(low, high)) {
    svg.append(element("line", { class: "grid", x1: LEFT, x2: WIDE - RIGHT, y1: y(value), y2: y(value) }));
    svg.append(element("text", { x: LEFT - 7, y: y(value) + 4, "text-anchor": "end" }, String(value)));
  }
  for (const time of times(until)) {
    svg.append(element("text", { x: x(time), y: HIGH - BOTTOM + 17, "text-anchor": "middle" }, String(time)));
  }
  svg.append(element("text", { x: (LEFT + WIDE - RIGHT) / 2, y: HIGH - 6, "text-anchor": "middle" }, "t [s]"));
  svg.append(element("text", { transform: `translate(13 ${(TOP + HIGH - BOTTOM) / 2}) rotate(-90)`, "text-anchor": "middle" }, "energy [mJ]"));
  svg.append(element("line", { class: "barrier", x1: LEFT, x2: WIDE - RIGHT, y1: y(barrier), y2: y(barrier) }));
  svg.append(element("text", { x: WIDE - RIGHT, y: y(barrier) - 5, "text-anchor": "end" }, "least energy to turn over"));
  for (const toss of there) {
    const points = toss.path.time.map((time, k) => `${x(time).toFixed(1)},${y(1e3 * toss.path.energy[k]).toFixed(1)}`);
    svg.append(element("polyline", { class: `line ${toss.engine}`, points: points.join(" ") }));
  }
  const now = element("line", { class: "now", y1: TOP, y2: HIGH - BOTTOM });
  svg.append(now);
  box.replaceChildren(svg);
  return (time) => {
    now.setAttribute("x1", x(Math.min(time, until)));
    now.setAttribute("x2", x(Math.min(time, until)));
  };
}

function levels(low, high) {
  const found = [], few = high / low > 300 ? [1] : [1, 2, 5];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (const part of few) found.push(Number((part * 10 ** power).toPrecision(3)));
  }
  return found.filter((value) => value >= low && value <= high);
}

function times(until) {
  const raw = until / 6 || 1, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((part) => part * power >= raw);
  return Array.from({ length: Math.floor(until / step + 1e-9) + 1 }, (_, k) => Number((k * step).toPrecision(6)));
}
