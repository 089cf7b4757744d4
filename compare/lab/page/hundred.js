// A hundred coins that are released a hair apart: their tosses, when they part, and how many show heads.

export const COINS = 100, SAMPLES = 300; // samples of each path
export const THINNEST = 1e-15, WIDEST = 1e-3;
const LIES = 0.1; // seconds in which a coin whose face is certain is laid on it
const SPIN = "release.angular_velocity.eta", HEIGHT = "release.position.z";

// What differs among the coins: the spin, or the height of a coin that does not spin.
export const variedField = (scenario) => (scenario[SPIN] ? SPIN : HEIGHT);

// The values of that field: evenly spread, each off by at most the part `hair` of itself.
export function spread(scenario, hair) {
  const middle = scenario[variedField(scenario)];
  return Float64Array.from({ length: COINS }, (_, i) => middle * (1 + hair * ((2 * i) / (COINS - 1) - 1)));
}

// Tosses all coins; `toss` returns the toss of a scenario, with a number of samples.
export function tossHundred(toss, scenario, hair) {
  const field = variedField(scenario);
  return Promise.all([...spread(scenario, hair)].map(async (value) => laid(await toss({ ...scenario, [field]: value }, SAMPLES), scenario)));
}

// A toss whose path goes on to where the coin lies on its face; to follow a hundred that far takes seconds.
function laid(toss, scenario) {
  const { path, coin, outcome } = toss, up = { heads: 1, tails: -1 }[outcome], [x, y] = path.position.slice(-3), end = path.time.at(-1) + LIES;
  if (!up || "ending.caught" in scenario) return toss;
  // The nearest attitude in which the normal is upright.
  const [e0, e1, e2, e3] = path.quaternion.slice(-4), flat = up > 0 ? [e0, 0, 0, e3] : [0, e1, e2, 0], size = Math.hypot(...flat);
  const position = [...path.position, x, y, coin.thickness / 2 + up * coin.center[2]], quaternion = [...path.quaternion, ...flat.map((part) => part / size)];
  return { ...toss, end_time: end, path: { ...path, time: [...path.time, end], position, quaternion } };
}

// The face at a touch, the last one of a toss that ended before; null where there was none.
export const faceAt = ({ sequence }, touch) => sequence[Math.min(touch, sequence.length) - 1] ?? null;

// Heads up at each touch.
export function headsByTouch(tosses) {
  const longest = Math.max(...tosses.map(({ sequence }) => sequence.length));
  return Array.from({ length: longest }, (_, i) => tosses.filter((one) => faceAt(one, i + 1) === "H").length);
}

// The first touch at which not all show the same face; null where all show the same to the end.
export function partingTouch(tosses) {
  const at = headsByTouch(tosses).findIndex((heads) => heads > 0 && heads < tosses.length);
  return at < 0 ? null : at + 1;
}

export function ends(tosses) {
  const count = (outcome) => tosses.filter((one) => one.outcome === outcome).length;
  return { heads: count("heads"), tails: count("tails") };
}

// The face up at a time: 1 where heads is.
export function isHeads({ path }, { at, part }) {
  const normal = (k) => {
    const [e0, e1, e2, e3] = path.quaternion.slice(4 * k, 4 * k + 4);
    return e0 * e0 + e3 * e3 - e1 * e1 - e2 * e2;
  };
  return normal(part < 0.5 ? at : Math.min(at + 1, path.time.length - 1)) > 0;
}
