// An axis of the map: the value at a pixel, its name and its unit.

export function valueAt(axis, index) {
  // As numpy.linspace, to the last bit: the pixel's toss is the map's.
  if (index === axis.count - 1) return axis.stop;
  return axis.start + index * ((axis.stop - axis.start) / (axis.count - 1));
}

export function indexOf(axis, value) {
  return ((value - axis.start) / (axis.stop - axis.start)) * (axis.count - 1);
}

const superscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹", ".": "·" };

export function unitOf(axis) {
  return axis.unit
    .replace(/\*\*(-?[\d.]+)/g, (_, power) => [...power].map((sign) => superscripts[sign]).join(""))
    .replaceAll("*", " ");
}

export function title(axis) {
  const unit = unitOf(axis);
  return unit ? `${axis.field} [${unit}]` : axis.field;
}

// A value with as many digits as tell it from the next, `step` away.
export function shown(value, step) {
  const size = Math.max(Math.abs(value), Math.abs(step));
  const digits = size === 0 || step === 0 ? 6 : Math.ceil(Math.log10(size / Math.abs(step))) + 2;
  return String(Number(value.toPrecision(Math.min(Math.max(digits, 4), 17))));
}
