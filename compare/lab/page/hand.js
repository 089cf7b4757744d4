// A hand: releases that scatter about one, and the share of heads among them with its interval.

const Z = 2.5758293035489004; // of a normal, within which are 99 %
const PART = 100; // tosses that are counted at a time
export const TOSSES = 2000;

// What a hand scatters, each relative to its size, by one normal number for each group.
const GROUPS = [["release.position.z"], ["release.velocity.x", "release.velocity.y", "release.velocity.z"],
  ["release.angular_velocity.xi", "release.angular_velocity.eta", "release.angular_velocity.zeta"]];

// A coin that is caught is caught at the height of its release.
const isHeld = (scenario, group) => group === 0 && "ending.caught" in scenario;

const groupOf = (field) => GROUPS.findIndex((group) => group.includes(field));

// Wilson's interval at 99 %, as the package counts shares.
export function wilson(met, count) {
  const share = met / count, square = Z ** 2 / count, middle = (share + square / 2) / (1 + square);
  const half = (Z / (1 + square)) * Math.sqrt((share * (1 - share)) / count + square / count / 4);
  return { share, low: Math.max(middle - half, 0), high: Math.min(middle + half, 1), count };
}

// Releases of a hand, values by field; the same for the same seed. `scatter` is the relative standard deviation of each.
export function releases(scenario, scatter, count, seed = 0) {
  const normal = normals(seed), found = {};
  const factors = Array.from({ length: count }, () => GROUPS.map(() => 1 + scatter * normal()));
  GROUPS.forEach((group, i) => {
    if (isHeld(scenario, i)) return;
    for (const field of group) if (scenario[field]) found[field] = Float64Array.from(factors, (factor) => scenario[field] * factor[i]);
  });
  return found;
}

// Points of the ellipse of one standard deviation about a release, over the fields of a map.
export function ellipse({ x, y, scenario }, scatter) {
  const reach = (field) => (groupOf(field) < 0 || isHeld(scenario, groupOf(field)) ? 0 : scatter * scenario[field]);
  const isOne = groupOf(x.field) === groupOf(y.field);
  return Array.from({ length: 97 }, (_, i) => {
    const angle = (i * Math.PI) / 48;
    return [scenario[x.field] + reach(x.field) * Math.cos(angle), scenario[y.field] + reach(y.field) * (isOne ? Math.cos(angle) : Math.sin(angle))];
  });
}

// Tosses a hand's releases, part by part, and calls `told` with the share of heads so far; `after` as in a map.
export async function countHeads(workers, { scenario, after, hand }, told, signal) {
  const all = releases(scenario, hand, TOSSES), followed = after === null ? scenario : { ...scenario, "ending.max_impacts": after + 1 };
  let met = 0, count = 0;
  for (let from = 0; from < TOSSES; from += PART) {
    const part = Object.fromEntries(Object.entries(all).map(([field, values]) => [field, values.slice(from, from + PART)]));
    const { outcome, impacts, lastFace } = await workers.tossEach(followed, part);
    if (signal.aborted) return;
    outcome.forEach((one, i) => {
      if (one < 0) return;
      count += 1;
      met += (after !== null && impacts[i] > after ? lastFace[i] : one) === 1;
    });
    if (count) told({ ...wilson(met, count), isWhole: from + PART >= TOSSES });
  }
}

// Numbers of a normal distribution by Box and Muller, from those of mulberry32.
function normals(seed) {
  let word = seed;
  const uniform = () => {
    word = (word + 0x6d2b79f5) | 0;
    let mixed = Math.imul(word ^ (word >>> 15), 1 | word);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}
