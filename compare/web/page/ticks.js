// Round numbers for an axis.

// Numbers between two ends, at most about `most` of them.
export function ticks(start, stop, most) {
  const low = Math.min(start, stop), high = Math.max(start, stop);
  const raw = (high - low) / Math.max(most, 1);
  const digit = Math.floor(Math.log10(raw)), power = 10 ** digit;
  const step = power * [1, 2, 5, 10].find((part) => part * power >= raw);
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high && found.length < 50; k++) {
    found.push(Number((k * step).toFixed(Math.max(-digit, 0))));
  }
  return { values: found, step };
}

// At most so many numbers for a logarithmic axis: powers of ten, with 2 and 5 between where these are few.
export function logTicks(low, high, most) {
  const decades = Math.log10(high / low), found = [];
  const parts = 3 * decades > most ? [1] : [1, 2, 5], every = Math.max(1, Math.ceil(decades / most));
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    if (power % every === 0) for (const part of parts) found.push(Number((part * 10 ** power).toPrecision(3)));
  }
  return found.filter((value) => value >= low && value <= high);
}
