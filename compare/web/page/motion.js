// What is plotted of the motion of tosses, each a plot of plot.js.

import { makePlot, makeSpan } from "./plot.js";

export const LABELS = { analytic: "analytic", mujoco: "MuJoCo" };

// What a toss is called: by its own label, or by its engine.
export const nameOf = (toss) => toss.label ?? LABELS[toss.engine];

const TURN = 180 / Math.PI;

function linesOf(tosses, values, more = {}) {
  return tosses.map((toss) => ({ name: nameOf(toss), kind: toss.engine, time: toss.path.time, values: values(toss.path), ...more }));
}

const along = (axis) => (path) => path.time.map((_, k) => 1e3 * path.position[3 * k + axis]);
const tiltOf = (path) => path.time.map((_, k) => {
  const [e0, e1, e2, e3] = path.quaternion.slice(4 * k, 4 * k + 4);
  return TURN * Math.acos(Math.min(Math.max(e0 * e0 + e3 * e3 - (e1 * e1 + e2 * e2), -1), 1));
});

export function heightOf(tosses) {
  const touches = (toss) => ({ kind: toss.engine, time: toss.times, values: toss.heights.map((each) => 1e3 * each) });
  return { title: "height of the mass centre", unit: "mm", range: [0], lines: linesOf(tosses, along(2)), dots: tosses.map(touches) };
}

export function placeOf(tosses) {
  const named = (axis, name, dotted) => linesOf(tosses, along(axis)).map((line) => ({ ...line, name: `${name} ${line.name}`, kind: `${line.kind}${dotted}` }));
  return { title: "horizontal position", unit: "mm", lines: [...named(0, "x", ""), ...named(1, "y", " second")] };
}

export function tiltsOf(tosses) {
  const at = [[0, "heads"], [45, "45"], [90, "90"], [135, "135"], [180, "tails"]];
  return { title: "tilt of the normal", unit: "°", range: [-3, 183], at, lines: linesOf(tosses, tiltOf) };
}

export function spinOf(tosses) {
  const second = linesOf(tosses, (path) => path.spin_normal).map((line) => ({ ...line, name: `about ζ ${line.name}`, kind: `${line.kind} second` }));
  return { title: "spin", unit: "rad/s", lines: [...linesOf(tosses, (path) => path.spin), ...second] };
}

export function energyOf(tosses) {
  const text = "least energy to turn over", same = tosses.every(({ coin }) => Math.abs(coin.barrier / tosses[0].coin.barrier - 1) < 1e-9);
  const levels = (same ? [tosses[0]] : tosses).map((toss) => ({ value: 1e3 * toss.coin.barrier, text: same ? text : `${text}: ${nameOf(toss)}` }));
  return { title: "energy", unit: "mJ", log: true, levels, lines: linesOf(tosses, (path) => path.energy.map((each) => 1e3 * each)) };
}

// Plots the energies of tosses, and returns what is to be called with the time that is played.
export function showEnergy(box, tosses, height = 230) {
  const there = tosses.filter((toss) => toss?.path), span = there.length ? makeSpan(there) : null;
  box.replaceChildren();
  if (span) makePlot(box, { ...energyOf(there), height }, span);
  return (time) => span?.play(time);
}
