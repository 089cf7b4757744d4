// Many tosses on workers, as many as the machine has cores; without workers in the page itself, part by part.

import { EngineError, changed, load, played, startWorker } from "./engine.js";

const SLOW = 4; // tosses in a millisecond on a core, until they are measured
const PICTURE = 60; // [ms] that the first pass should take
const PARTS = { least: 8, most: 40, growth: 1 / 8 }; // [ms] that a part of a map should take, longer the longer the map has taken
const FEWEST = 16; // tosses of a part
const COARSEST = 500; // pixels of a first pass before the rate is measured
const LONGEST = 16; // workers

/** Start the workers; see engine.d.ts. */
export async function startWorkers(bytes, version) {
  const engine = await load(bytes, version);
  const workers = new Workers(engine);
  await workers.start(Math.min(Math.max(globalThis.navigator?.hardwareConcurrency ?? 1, 1), LONGEST), bytes);
  return workers;
}

export class Workers {
  tossMap = null;
  #idle = [];
  #waiting = [];
  #all = new Set();
  #rates = new Map(); // tosses in a millisecond, as measured, of each kind of map
  #bytes = null;

  constructor(engine) {
    this.engine = engine;
  }

  /** Workers that run; 0 where the page itself tosses. */
  get count() {
    return this.#all.size;
  }

  start(count, bytes) {
    this.#bytes = bytes;
    return Promise.all(Array.from({ length: count }, () => this.#add()));
  }

  async #add() {
    let worker;
    try {
      worker = new Thread(startWorker(), () => this.#replace(worker));
      await worker.ask("load", [this.engine.module]).catch(() => worker.ask("load", [this.#bytes]));
    } catch {
      worker?.end();
      return; // the page tosses without it
    }
    this.#all.add(worker);
    this.#free(worker);
  }

  /** The toss of a scenario, as a page plays it. */
  toss(scenario, samples) {
    return this.#run("played", [scenario, samples], () => played(this.engine.toss(scenario), samples), true);
  }

  /** Many tosses, as `Engine.tossEach`. */
  tossEach(scenario, changes, wanted) {
    return this.#run("each", [scenario, changes, wanted], () => this.engine.tossEach(scenario, changes, wanted), true);
  }

  /** A map, coarse pixels first; see engine.d.ts. */
  async map(scenario, x, y, { after = null, trust = false } = {}, onPart, signal) {
    // Pixels that are no scenario are answered as such.
    const { "release.spin": _, ...others } = scenario, own = ({ field, start }) => (field === "release.spin" ? {} : { [field]: scenario[field] ?? start });
    const row = this.engine.row(changed(others, { ...own(x), ...own(y) }));
    const asked = { row, x, y, after, trust }, kind = `${after} ${trust}`;
    return this.tossMap ? this.#mapThere(asked, kind, onPart, signal) : this.#mapHere(asked, kind, onPart, signal);
  }

  async #mapHere({ row, x, y, after, trust }, kind, onPart, signal) {
    const ends = Math.max(this.count, 1), rate = () => this.#rates.get(kind) ?? SLOW;
    const parts = passes(x.count, y.count, this.#soon(kind, ends)), running = new Set();
    const size = () => rate() * Math.min(Math.max(worked * PARTS.growth, PARTS.least), PARTS.most);
    let failed = null, worked = 0;
    const next = async () => {
      for (let part; !failed && !signal?.aborted && (part = parts.take(size(), ends)); ) {
        const { pass, pixels } = part, at = (axis, place) => ({ field: axis.field, values: Float64Array.from(pixels, (pixel) => valueAt(axis, place(pixel))) });
        const given = { row, x: at(x, (pixel) => pixel % x.count), y: at(y, (pixel) => Math.floor(pixel / x.count)), after, trust };
        const { time, ...found } = await this.#run("pixels", [given], () => this.engine.tossPixels(given));
        this.#measured(kind, pixels.length, time);
        worked += time / ends;
        if (signal?.aborted) break;
        onPart({ stride: pass.stride, pixels, ...found, finished: parts.finish(part) });
      }
    };
    for (let i = 0; i < ends; i++) running.add(next().catch((problem) => (failed ??= problem)));
    await Promise.all(running);
    if (failed) throw failed;
    signal?.throwIfAborted();
  }

  // A server tosses whole maps: a small one first, where it would not have the large one soon.
  async #mapThere(asked, kind, onPart, signal) {
    const { x, y } = asked, first = strideFor(x.count, y.count, this.#soon(kind, 1));
    for (const stride of first > 1 ? [first, 1] : [1]) {
      const columns = middles(x.count, stride), rows = middles(y.count, stride), begun = performance.now();
      const part = (axis, places) => ({ ...axis, start: valueAt(axis, places[0]), stop: valueAt(axis, places.at(-1)), count: places.length });
      const found = await this.tossMap({ ...asked, x: part(x, columns), y: part(y, rows) }, signal);
      this.#measured(kind, columns.length * rows.length, performance.now() - begun);
      onPart({ stride, pixels: Int32Array.from(rows.flatMap((row) => columns.map((column) => row * x.count + column))), ...found, finished: stride });
    }
  }

  // Pixels that are tossed in the time of a picture.
  #soon = (kind, ends) => Math.max((this.#rates.get(kind) ?? 0) * ends * PICTURE, COARSEST);

  #measured(kind, count, time) {
    const rate = count / Math.max(time, 0.1);
    this.#rates.set(kind, ((this.#rates.get(kind) ?? rate) + rate) / 2);
  }

  /** End the workers; what they were asked is refused. */
  end() {
    const all = [...this.#all];
    this.#all.clear();
    for (const worker of all) worker.end();
    for (const { reject } of this.#waiting.splice(0)) reject(new EngineError("the engine was ended"));
  }

  // What a worker answers; in the page where there is none, after what waits to be drawn. What is clicked comes first.
  async #run(method, given, here, isFirst = false) {
    if (!this.count) {
      await new Promise((resolve) => setTimeout(resolve));
      return here();
    }
    const worker = this.#idle.pop() ?? (await new Promise((resolve, reject) => this.#waiting[isFirst ? "unshift" : "push"]({ resolve, reject })));
    try {
      return await worker.ask(method, given);
    } finally {
      if (worker.isAlive) this.#free(worker);
    }
  }

  #free(worker) {
    const next = this.#waiting.shift();
    if (next) next.resolve(worker);
    else this.#idle.push(worker);
  }

  // One that never ran is not replaced.
  #replace(worker) {
    this.#idle = this.#idle.filter((each) => each !== worker);
    if (!this.#all.delete(worker)) return;
    this.#add().then(() => {
      if (!this.count) for (const { reject } of this.#waiting.splice(0)) reject(new EngineError("a worker has died, and no other starts: load the page again"));
    });
  }
}

// A worker that is asked one thing at a time.
class Thread {
  #worker;
  #onDeath;
  #waits = null;
  isAlive = true;

  constructor(worker, onDeath) {
    this.#worker = worker;
    this.#onDeath = onDeath;
    worker.onmessage = ({ data: { answer, problem } }) => this.#settle(problem === undefined ? null : new EngineError(problem), answer);
    worker.onerror = (event) => {
      event.preventDefault();
      this.#die(event.message ? ` (${event.message})` : "");
    };
    worker.onmessageerror = () => this.#die("");
  }

  ask(method, given) {
    return new Promise((resolve, reject) => {
      this.#waits = { resolve, reject };
      this.#worker.postMessage({ method, given });
    });
  }

  end() {
    this.#die("");
  }

  #die(why) {
    this.isAlive = false;
    this.#worker.terminate();
    this.#settle(new EngineError(`a worker of the engine has died${why}`));
    this.#onDeath();
  }

  #settle(problem, answer) {
    const waits = this.#waits;
    this.#waits = null;
    problem ? waits?.reject(problem) : waits?.resolve(answer);
  }
}

// The pixels of a map in passes of ever finer strides, each pixel once. After a pass each square of its stride has one
// tossed pixel, at a place that looks random: a pattern that is finer than the stride shows as noise, not as other stripes.
function passes(columns, rows, most) {
  const open = [];
  let next = strideFor(columns, rows, most), pass = null, finished = null;
  return {
    // The next part, of about so many tosses; null where all were taken. Of the first pass each worker has one part.
    take(tosses, workers) {
      if (!pass || pass.taken === pass.pixels.length) {
        if (next === 0) return null;
        const pixels = spread(columns, rows, next, pass?.stride ?? null), isFirst = !pass;
        pass = { stride: next, pixels, taken: 0, left: pixels.length, size: isFirst ? Math.ceil(pixels.length / workers) : 0 };
        next = next > 1 ? finer(next) : 0;
        open.push(pass);
      }
      const pixels = pass.pixels.slice(pass.taken, pass.taken + Math.max(Math.ceil(pass.size || tosses), FEWEST));
      pass.taken += pixels.length;
      return { pass, pixels };
    },
    // Takes a part as tossed; returns the stride of the last pass that is tossed whole, or null.
    finish({ pass, pixels }) {
      pass.left -= pixels.length;
      while (open.length && !open[0].left) finished = open.shift().stride;
      return finished;
    },
  };
}

// Strides are 1, 2, 3, 4, 6, 8, 12 and so on; a square of one has four or nine of the next that its pixels come to.
const coarser = (stride) => (stride === 1 ? 2 : stride & (stride - 1) ? (stride / 3) * 4 : stride * 1.5);
const finer = (stride) => (stride === 3 ? 1 : stride / 2);

// The least stride at which a map has no more than so many pixels.
function strideFor(columns, rows, most) {
  let stride = 1;
  while (stride < Math.max(columns, rows) && Math.ceil(columns / stride) * Math.ceil(rows / stride) > most) stride = coarser(stride);
  return stride;
}

const middles = (count, stride) => Array.from({ length: Math.ceil(count / stride) }, (_, i) => Math.min(i * stride + (stride >> 1), count - 1));

// One pixel of each square of a stride, without those of the stride before.
function spread(columns, rows, stride, before) {
  const found = [], across = Math.ceil(columns / stride), up = Math.ceil(rows / stride), parts = before / stride;
  const inside = ([i, j], size) => {
    const next = finer(size), count = size / next, pick = mixed(i, j, size) % count ** 2, a = count * i + (pick % count), b = count * j + Math.floor(pick / count);
    return [a * next < columns ? a : count * i, b * next < rows ? b : count * j];
  };
  for (let j = 0; j < up; j++) {
    for (let i = 0; i < across; i++) {
      if (before) {
        const [a, b] = inside([Math.floor(i / parts), Math.floor(j / parts)], before);
        if (a === i && b === j) continue;
      }
      let place = [i, j];
      for (let size = stride; size > 1; size = finer(size)) place = inside(place, size);
      found.push(place[1] * columns + place[0]);
    }
  }
  return Int32Array.from(found);
}

// A whole number that looks random, always the same one for the same square.
function mixed(i, j, size) {
  let word = Math.imul(i + 1, 0x9e3779b1) ^ Math.imul(j + 1, 0x85ebca77) ^ Math.imul(size, 0xc2b2ae3d);
  word = Math.imul(word ^ (word >>> 15), 0x2c1b3c6d);
  word = Math.imul(word ^ (word >>> 12), 0x297a2d39);
  return (word ^ (word >>> 15)) >>> 0;
}

// As numpy.linspace, to the last bit.
const valueAt = ({ start, stop, count }, place) => (place === count - 1 ? stop : start + place * ((stop - start) / (count - 1)));
