// Values known at sorted times.

// The last sample before a time, and which part of the way to the next has gone.
export function placeIn(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  const span = (times[low + 1] ?? times[low]) - times[low];
  return { at: low, part: span > 0 ? Math.min(Math.max((time - times[low]) / span, 0), 1) : 0 };
}

// The value at a time, on a straight line between two samples; null where there are none.
export function valueAt(times, values, time) {
  if (!times.length || time < times[0] || time > times.at(-1)) return null;
  const { at, part } = placeIn(times, time);
  return part ? values[at] + part * (values[at + 1] - values[at]) : values[at];
}
