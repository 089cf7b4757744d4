// Many tosses on workers, as many as the machine has cores; without workers in the page itself, part by part.

import { EngineError, changed, load, played, startWorker } from "./engine.js";

const FIRST = 64; // tosses of the first parts
const PART = 25; // [ms] that a part of a map should take
const MOST = 4096; // tosses of a part
const COARSEST = 400; // pixels of the first pass, about
const LONGEST = 16; // workers

/** Start the workers; see engine.d.ts. */
export async function startWorkers(bytes, version) {
  const engine = await load(bytes, version);
  const count = Math.min(Math.max(globalThis.navigator?.hardwareConcurrency ?? 1, 1), LONGEST);
  const workers = new Workers(engine);
  await workers.start(count, bytes);
  return workers;
}

export class Workers {
  tossMap = null;
  #idle = [];
  #waiting = [];
  #all = new Set();
  #rate = 0; // tosses in a millisecond, as measured
  #bytes = null;

  constructor(engine) {
    this.engine = engine;
  }

  /** Workers that run; 0 where the page itself tosses. */
  get count() {
    return this.#all.size;
  }

  async start(count, bytes) {
    this.#bytes = bytes;
    await Promise.all(Array.from({ length: count }, () => this.#add()));
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
    const row = this.engine.row(changed(scenario, { [x.field]: x.start, [y.field]: y.start }));
    if (this.tossMap) {
      const found = await this.tossMap({ row, x, y, after, trust }, signal), all = ({ count }) => Int32Array.from({ length: count }, (_, i) => i);
      return onPart({ stride: 1, columns: all(x), rows: all(y), ...found });
    }
    const parts = passes(x.count, y.count), running = new Set(), ends = Math.max(this.count, 1);
    let failed = null;
    const next = async () => {
      for (let part; !failed && !signal?.aborted && (part = parts.take(this.#size(trust))); ) {
        const { stride, columns, rows } = part, at = (axis, places) => ({ field: axis.field, values: Float64Array.from(places, (place) => valueAt(axis, place)) });
        const given = { row, x: at(x, columns), y: at(y, rows), after, trust }, begun = performance.now();
        const { codes, trusted } = await this.#run("grid", [given], () => this.engine.tossGrid(given));
        this.#rate = this.#rate / 2 + (columns.length * rows.length) / Math.max(performance.now() - begun, 0.1) / 2;
        if (signal?.aborted) break;
        onPart({ stride, columns, rows, codes, trusted });
      }
    };
    for (let i = 0; i < ends; i++) running.add(next().catch((problem) => (failed ??= problem)));
    await Promise.all(running);
    if (failed) throw failed;
    signal?.throwIfAborted();
  }

  /** End the workers; what they were asked is refused. */
  end() {
    const all = [...this.#all];
    this.#all.clear();
    for (const worker of all) worker.end();
    for (const { reject } of this.#waiting.splice(0)) reject(new EngineError("the engine was ended"));
  }

  #size = (trust) => Math.min(Math.max(Math.round(this.#rate * PART) || FIRST, trust ? 8 : 16), MOST);

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
    this.#worker.terminate();
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
    if (problem) waits?.reject(problem);
    else waits?.resolve(answer);
  }
}

// The pixels of a map, in passes of ever finer strides, each pixel once: parts of some rows and columns.
function passes(columns, rows) {
  let stride = 1;
  while ((columns / stride) * (rows / stride) > COARSEST) stride *= 2;
  const every = (count, first, step) => Array.from({ length: Math.max(Math.ceil((count - first) / step), 0) }, (_, i) => first + i * step);
  const queue = [{ stride, columns: every(columns, 0, stride), rows: every(rows, 0, stride) }];
  for (let next = stride / 2; next >= 1; next /= 2) {
    queue.push({ stride: next, columns: every(columns, next, 2 * next), rows: every(rows, 0, 2 * next) });
    queue.push({ stride: next, columns: every(columns, 0, next), rows: every(rows, next, 2 * next) });
  }
  return {
    // The next part, of about so many tosses; null where all were taken.
    take(tosses) {
      while (queue.length && !(queue[0].rows.length && queue[0].columns.length)) queue.shift();
      if (!queue.length) return null;
      const { stride, columns, rows } = queue[0];
      return { stride, columns: Int32Array.from(columns), rows: Int32Array.from(rows.splice(0, Math.max(Math.floor(tosses / columns.length), 1))) };
    },
  };
}

// As numpy.linspace, to the last bit.
const valueAt = ({ start, stop, count }, place) => (place === count - 1 ? stop : start + place * ((stop - start) / (count - 1)));
