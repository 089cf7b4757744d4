// The axis of time of tosses: flight and bounces have most of it, the wobble after them the rest.

import { valueAt } from "./sampled.js";

const BOUNCES = 0.8; // the part of the axis that flight and bounces have
const LOW = 1 / 100; // of the highest bounce: after a lower one the coin wobbles
const LATER = 1e-6; // a path that is longer by so little ends with its toss

const endOf = (toss) => Math.max(toss.end_time, toss.path.time.at(-1));

// The touches of a toss, those after its outcome was settled too.
export const touchesOf = (toss) => [...toss.times, ...(toss.later_times ?? [])];

// When the last bounce of a toss ends that is no wobble: how high the coin rises above where it touches says so.
function bouncesEnd(toss) {
  const times = touchesOf(toss), { time, position } = toss.path, top = times.map(() => 0);
  for (let k = 0, i = 0; k < time.length; k++) {
    while (i < times.length && times[i] < time[k]) i++;
    if (i < times.length) top[i] = Math.max(top[i], position[3 * k + 2]);
  }
  const heights = time.map((_, k) => position[3 * k + 2]), low = times.map((each) => valueAt(time, heights, each) ?? 0);
  const rises = top.map((high, i) => high - Math.max(low[i], i ? low[i - 1] : 0));
  const last = rises.findLastIndex((rise) => rise > LOW * Math.max(...rises));
  return last < 0 ? endOf(toss) : times[last];
}

// What the marks of `proofs` say.
export const proofText = (proofs) => (proofs.length > 1 ? "from its mark on each can't turn over" : "from here on it can't turn over");

// Returns the axis of some tosses: its end; `pivot`, the time from which on its scale is another, or the end, and the
// place of that, `bend`; the `proofs`, from which on a coin can't turn over, where its path goes on; and how a time and
// its place, both from 0 to the end, depend on each other.
export function makeTimeline(tosses) {
  const there = tosses.filter((toss) => toss?.path), end = Math.max(0, ...there.map(endOf)) || 1;
  const bounces = Math.max(0, ...there.map(bouncesEnd)), isBent = bounces > 0 && bounces < BOUNCES * end;
  const pivot = isBent ? bounces : end, bend = isBent ? BOUNCES * end : end;
  const rest = isBent ? (end - bend) / (end - pivot) : 1;
  return {
    end, pivot, bend, isEmpty: !there.length,
    proofs: there.filter((toss) => endOf(toss) > toss.end_time * (1 + LATER)).map(({ engine, end_time }) => ({ engine, time: end_time })).sort((a, b) => a.time - b.time),
    placeOf: (time) => (time <= pivot ? (time / pivot) * bend : bend + (time - pivot) * rest),
    timeAt: (place) => (place <= bend ? (place / bend) * pivot : pivot + (place - bend) / rest),
  };
}
