// The challenge: coins thrown by hand, how much the hand scatters, and what Keller's coin makes of it.

const GRAVITY = 9.81;
export const ROW = 3; // heads in a row that win

// The longest row of heads among throws of { speed, spin, outcome }.
export function longestRow(throws) {
  let row = 0, longest = 0;
  for (const { outcome } of throws) longest = Math.max(longest, (row = outcome === "heads" ? row + 1 : 0));
  return longest;
}

const meanOf = (values) => values.reduce((sum, each) => sum + each, 0) / values.length;

// Mean, and standard deviation relative to it; null for fewer than two throws.
function scattered(values) {
  if (values.length < 2) return null;
  const mean = meanOf(values), square = values.reduce((sum, each) => sum + (each - mean) ** 2, 0) / (values.length - 1);
  return { mean, scatter: Math.sqrt(square) / mean };
}

// The hand of some throws: its mean speed and spin, the scatter of both together, and that of the turns, in turns.
export function handOf(throws) {
  const speed = scattered(throws.map((each) => each.speed)), spin = scattered(throws.map((each) => each.spin));
  if (!speed || !spin) return null;
  const turns = scattered(throws.map(turnsOf));
  return { speed: speed.mean, spin: spin.mean, scatter: Math.hypot(speed.scatter, spin.scatter) / Math.SQRT2, turns: turns.mean * turns.scatter };
}

// Turns of a coin until it is caught where it was released (Keller 1986).
export const turnsOf = ({ speed, spin }) => (spin * speed) / (Math.PI * GRAVITY);

// The largest share of heads of a hand whose turns scatter normally, whatever their mean: the mean of the square wave
// that is heads within a quarter of whole turns.
export function kellersCurve(turns) {
  if (turns === 0) return 1;
  let sum = 0;
  for (let k = 0; k < 200; k++) {
    const odd = 2 * k + 1;
    sum += ((k % 2 ? -1 : 1) / odd) * Math.exp(-((2 * Math.PI * odd * turns) ** 2) / 2);
  }
  return Math.min(0.5 + (2 / Math.PI) * sum, 1);
}
