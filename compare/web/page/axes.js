// An axis of the map: the value at a pixel, and its title.

export function valueAt(axis, index) {
  // As numpy.linspace, to the last bit: the pixel's toss is the map's.
  if (index === axis.count - 1) return axis.stop;
  return axis.start + index * ((axis.stop - axis.start) / (axis.count - 1));
}

export function indexOf(axis, value) {
  return ((value - axis.start) / (axis.stop - axis.start)) * (axis.count - 1);
}

export function title(axis) {
  return axis.unit ? `${axis.word} [${axis.unit}]` : axis.word;
}

// A value with enough digits to differ from the next value, `step` away.
export function shown(value, step) {
  const size = Math.max(Math.abs(value), Math.abs(step));
  const digits = size === 0 || step === 0 ? 6 : Math.ceil(Math.log10(size / Math.abs(step))) + 2;
  return String(Number(value.toPrecision(Math.min(Math.max(digits, 4), 17))));
}
