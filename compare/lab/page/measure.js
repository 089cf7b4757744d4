// Measurements of the browser: tosses per second, and how fast a map comes.

import { load } from "./engine.js";
import { counted } from "./outcome.js";

const LONG = 700; // milliseconds of each kind of toss
const SLICE = 50;

// The coin of Fig. 24(a), which turns in one plane, and one that does not: with its mass centre aside.
const PLANE = {
  "coin.mass": 0.002, "coin.radius": 0.0125, "coin.thickness": 0.002, "air.normal": 0.8, "air.tangential": 0.2, "floor.restitution": 0.8,
  "floor.contact": "smooth", "release.position.x": 0, "release.position.y": 0, "release.position.z": 0.40001, "release.angles.theta": (7 * Math.PI) / 180, "release.angular_velocity.eta": 40.15,
};
const GENERAL = { ...PLANE, "coin.center_of_mass.xi": -0.001, "coin.center_of_mass.eta": -0.001, "coin.center_of_mass.zeta": -0.0002 };
const MAP = [{ field: "release.angular_velocity.eta", start: 20, stop: 60, count: 400 }, { field: "release.position.z", start: 0.2, stop: 0.6, count: 300 }];

// Calls `told` with rows of [what, value] as they come.
export async function measure(bytes, workers, told) {
  const begun = performance.now(), engine = await load(bytes);
  engine.toss(PLANE);
  told("the engine compiled, and its first toss", `${(performance.now() - begun).toFixed(0)} ms`);
  told("planar tosses to their end, one core", `${await rate(engine, PLANE)} tosses/s`);
  told("tosses of an imperfect coin to their end, one core", `${await rate(engine, GENERAL)} tosses/s`);
  const start = performance.now(), { signal } = new AbortController();
  let first = null;
  await workers.map(PLANE, ...MAP, { after: 2, trust: false }, ({ finished }) => {
    if (finished === null || first) return;
    first = performance.now() - start;
    told("400 by 300 map of Fig. 24(a), third touch: first seen", `${(first / 1000).toFixed(2)} s`);
  }, signal);
  const whole = performance.now() - start;
  told(`the same map, whole, on ${counted(workers.count, "worker")}`, `${(whole / 1000).toFixed(2)} s, ${Math.round((120000 / whole) * 1000)} tosses/s`);
  told("memory of the engine", `${(engine.memory / 1e6).toFixed(1)} MB`);
}

// Tosses from heights that differ a little, for about `LONG`.
async function rate(engine, scenario) {
  let tossed = 0, busy = 0;
  for (let size = 4; busy < LONG; ) {
    const heights = Float64Array.from({ length: size }, (_, i) => 0.4 + 1e-5 * (tossed + i)), from = performance.now();
    engine.tossEach(scenario, { "release.position.z": heights });
    const took = performance.now() - from;
    tossed += size;
    busy += took;
    size = Math.max(1, Math.min(5000, Math.round((size * SLICE) / Math.max(took, 1))));
    await new Promise((kept) => setTimeout(kept));
  }
  return Math.round((1000 * tossed) / busy).toLocaleString("en");
}
