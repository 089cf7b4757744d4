// The axis of time of tosses: flight and bounces have most of it, the wobble after them the rest.

const BOUNCES = 0.8; // the part of the axis that flight and bounces have
const APART = 1 / 10; // of the longest flight: after a shorter one, which is a hundredth as high, the coin wobbles
const LATER = 1e-6; // a path that is longer by so little ends with its toss

const endOf = (toss) => Math.max(toss.end_time, toss.path.time.at(-1));

// The touches of a toss, those after its outcome was settled too.
export const touchesOf = (toss) => [...toss.times, ...(toss.later_times ?? [])];

// When the last bounce of a toss ends that is no wobble.
function bouncesEnd(toss) {
  const times = touchesOf(toss), flights = times.map((time, i) => time - (i ? times[i - 1] : 0));
  const longest = Math.max(0, ...flights), last = flights.findLastIndex((flight) => flight > APART * longest);
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
