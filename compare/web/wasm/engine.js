// The analytic engine in a page: it takes rows of numbers in SI, and gives its memory back after each call.

const WORD = 8; // bytes of a number, and of an integer that is passed
const STATE = 13; // numbers of a state of the coin
const SECTION = "cointoss"; // of engine.wasm, says what made it
const MOST_BYTES = 2 ** 31; // that the engine is asked for at once
const ROOM = { impacts: 256, pieces: 512 }; // for one toss at first

export class EngineError extends Error {}

/** Load engine.wasm; `version` is that of the page, if it asks for its own. */
export async function load(bytes, version) {
  if (typeof WebAssembly === "undefined") throw new EngineError("this browser has no WebAssembly");
  let module;
  try {
    module = await WebAssembly.compile(bytes);
  } catch (problem) {
    throw new EngineError(`engine.wasm: cannot be read (${problem.message})`);
  }
  const [section] = WebAssembly.Module.customSections(module, SECTION);
  if (!section) throw new EngineError("engine.wasm: is no engine of cointoss");
  const about = JSON.parse(new TextDecoder().decode(section));
  if (version !== undefined && about.version !== version)
    throw new EngineError(`engine.wasm: of version ${about.version}; accepted: ${version}`);
  const { exports } = await WebAssembly.instantiate(module);
  exports._initialize();
  return new Engine(exports, about);
}

export class Engine {
  #exports;

  constructor(exports, about) {
    this.#exports = exports;
    this.about = about;
  }

  /** Bytes of memory that the engine holds. */
  get memory() {
    return this.#exports.memory.buffer.byteLength;
  }

  /** Toss a coin once from each release; see engine.d.ts. */
  tossEach(numbers, releases, wanted = "outcome") {
    const level = ["outcome", "trust", "certain"].indexOf(wanted);
    if (level < 0) throw new EngineError(`wanted: ${wanted}; accepted: outcome, trust, certain`);
    const width = this.about.answer.length, count = releases.length / STATE, given = this.#row(numbers);
    if (!Number.isInteger(count)) throw new EngineError(`releases: ${releases.length} numbers; accepted: 13 for each`);
    requireReleases(releases);
    const answers = this.#run([given, releases, count * width], ([first, second, third], call) => {
      call("toss_each", row(first, given.length), table(second, count, STATE), [level], table(third, count, width));
      return this.#read(third, count * width);
    });
    const column = (name, Kind) => Kind.from({ length: count }, (_, i) => answers[i * width + this.about.answer.indexOf(name)]);
    return {
      outcome: column("outcome", Int8Array),
      ending: column("ending", Int8Array),
      impacts: column("impacts", Int32Array),
      lastFace: column("last_face", Int8Array),
      endTime: column("end_time", Float64Array),
      trustedImpacts: level > 0 ? column("trusted_impacts", Int32Array) : null,
      outcomeCertain: level > 1 ? column("outcome_certain", Int8Array) : null,
    };
  }

  /** Toss a coin and keep its impacts and its path; see engine.d.ts. */
  toss(numbers, release) {
    const { answer: names, impact, piece } = this.about, wide = impact.length, given = this.#row(numbers);
    if (release.length !== STATE) throw new EngineError(`release: ${release.length} numbers; accepted: 13`);
    requireReleases(release);
    for (let room = ROOM; ; ) {
      const { impacts: most, pieces: length } = room;
      const found = this.#run([given, release, names.length, most * wide, length * piece, 2], (at, call) => {
        call("toss_one", row(at[0], given.length), row(at[1], STATE), row(at[2], names.length),
          table(at[3], most, wide), table(at[4], length, piece), row(at[5], 2));
        const [impacts, pieces] = this.#read(at[5], 2);
        if (impacts > most || pieces > length) return { impacts, pieces };
        return { answer: this.#read(at[2], names.length), hits: this.#read(at[3], impacts * wide), path: this.#read(at[4], pieces * piece) };
      });
      if (found.answer) return this.#told(given, found);
      room = found;
    }
  }

  #told(numbers, { answer, hits, path }) {
    const of = (name) => answer[this.about.answer.indexOf(name)], wide = this.about.impact.length;
    const impacts = Array.from({ length: hits.length / wide }, (_, i) => {
      const [time, face, energy, ...impulse] = hits.subarray(i * wide, (i + 1) * wide);
      return { time, face: face === 1 ? "H" : "T", energy, impulse };
    });
    const [ending, sentence] = this.about.endings[of("ending")];
    return {
      outcome: this.about.outcomes[of("outcome")],
      ending,
      sentence,
      endTime: of("end_time"),
      impacts,
      sequence: impacts.map(({ face }) => face).join(""),
      trustedImpacts: of("trusted_impacts"),
      outcomeCertain: of("outcome_certain") === 1,
      path: (times) => this.#sample(numbers, path, times),
    };
  }

  #sample(numbers, path, times) {
    const { piece } = this.about, count = times.length, end = path[path.length - piece];
    for (let i = 0; i < count; i++)
      if (!(times[i] >= (i ? times[i - 1] : 0) && times[i] <= end))
        throw new EngineError(`times: ${times[i]} at ${i}; accepted: increasing from 0 to ${end} s`);
    return this.#run([numbers, path, times, count * STATE, count * 4], (at, call) => {
      call("sample_path", row(at[0], numbers.length), table(at[1], path.length / piece, piece), row(at[2], count),
        table(at[3], count, STATE), table(at[4], count, 4));
      const more = this.#read(at[4], count * 4);
      return {
        states: this.#read(at[3], count * STATE),
        energies: more.filter((_, i) => i % 4 === 0),
        forces: more.filter((_, i) => i % 4 !== 0),
      };
    });
  }

  // A scenario's numbers, where null stands for what is endless, as JSON has it.
  #row(numbers) {
    const { numbers: length, endless } = this.about;
    if (numbers.length !== length) throw new EngineError(`numbers: ${numbers.length} of them; accepted: ${length}`);
    return Float64Array.from(numbers, (number, i) => {
      const found = number === null && endless.includes(i) ? Infinity : number;
      if (typeof found === "number" && (Number.isFinite(found) || (found === Infinity && endless.includes(i)))) return found;
      throw new EngineError(`numbers: ${number} at ${i}; accepted: a finite number`);
    });
  }

  #read(address, count) {
    return new Float64Array(this.#exports.memory.buffer, address, count).slice();
  }

  // Make room for numbers that are given, or for so many, run a calculation, and free the room.
  #run(parts, calculate) {
    const held = [], make = (count) => {
      const bytes = Math.max(count, 1) * WORD, address = bytes < MOST_BYTES ? this.#exports.malloc(bytes) >>> 0 : 0;
      if (address === 0) throw new EngineError(`the browser refuses ${count * WORD} bytes of memory`);
      held.push(address);
      return address;
    };
    try {
      const places = parts.map((part) => {
        if (typeof part === "number") return make(part);
        const address = make(part.length);
        new Float64Array(this.#exports.memory.buffer, address, part.length).set(part);
        return address;
      });
      const call = (name, ...passed) => {
        const words = passed.flat(), given = make(words.length), answer = make(1), error = make(1);
        new BigInt64Array(this.#exports.memory.buffer, given, words.length).set(words.map(BigInt));
        if (this.#exports[name](given, answer, error) !== 0) throw new EngineError(`${name}: the engine failed`);
      };
      return calculate(places, call);
    } finally {
      for (const address of held) this.#exports.free(address);
    }
  }
}

function requireReleases(numbers) {
  for (let i = 0; i < numbers.length; i++)
    if (!Number.isFinite(numbers[i])) throw new EngineError(`release: ${numbers[i]} at ${i % STATE}; accepted: a finite number`);
  for (let i = 0; i < numbers.length; i += STATE) {
    const norm = Math.hypot(numbers[i + 6], numbers[i + 7], numbers[i + 8], numbers[i + 9]);
    if (!(Math.abs(norm - 1) < 1e-6)) throw new EngineError(`release: a quaternion of norm ${norm}; accepted: 1`);
  }
}

// An array of numbers as the engine takes it: its size, the bytes of a number, its place, shape and strides.
const row = (address, length) => [0, 0, length, WORD, address, length, WORD];
const table = (address, rows, columns) => [0, 0, rows * columns, WORD, address, rows, columns, columns * WORD, WORD];
