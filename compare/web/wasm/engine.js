// The analytic engine in a page: it tosses scenarios, and gives its memory back after each call.
//
// A scenario is an object of its fields, numbers in SI: { "coin.radius": 0.0125, "floor.contact": "smooth", ... }.

const WORD = 8; // bytes of a number, and of an integer that is passed
const STATE = 13; // numbers of a state of the coin
const SECTION = "cointoss"; // of engine.wasm, says what made it
const MOST_BYTES = 2 ** 31; // that the engine is asked for at once
const ROOM = { impacts: 256, pieces: 512 }; // for one toss at first
const AT_ONCE = 4096; // scenarios that are passed at a time
const WANTED = ["outcome", "trust", "certain"];
const SPIN = "release.spin", SPINS = ["xi", "eta", "zeta"].map((axis) => `release.angular_velocity.${axis}`);
const LISTS = { "release.angles": 0, "release.quaternion": null, "coin.inertia": null }; // each whole or not at all; what is missing

export class EngineError extends Error {}

/** The bytes of engine.wasm from a page's data, where they stand by gzip and base64. */
export async function unpacked(text) {
  const packed = new Blob([Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0))]).stream();
  return new Uint8Array(await new Response(packed.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());
}

/** Load engine.wasm; `version` is that of the page, if it asks for its own. */
export async function load(bytes, version) {
  if (typeof WebAssembly === "undefined") throw new EngineError("this browser has no WebAssembly");
  const tried = (made, what) => made.catch((problem) => Promise.reject(new EngineError(`engine.wasm: cannot be ${what} (${problem.message})`)));
  const module = bytes instanceof WebAssembly.Module ? bytes : await tried(WebAssembly.compile(bytes), "read");
  const [section] = WebAssembly.Module.customSections(module, SECTION);
  if (!section) throw new EngineError("engine.wasm: is no engine of cointoss");
  const about = JSON.parse(new TextDecoder().decode(section));
  if (version !== undefined && about.version !== version) throw new EngineError(`engine.wasm: of version ${about.version}; accepted: ${version}`);
  const { exports } = await tried(WebAssembly.instantiate(module), "started");
  return new Engine(exports, about, module);
}

export class Engine {
  #exports;

  constructor(exports, about, module) {
    this.#exports = exports;
    this.about = about;
    this.module = module;
    this.places = new Map(about.fields.map(({ name }, i) => [name, i]));
  }

  /** Bytes of memory that the engine holds. */
  get memory() {
    return this.#exports.memory.buffer.byteLength;
  }

  /** What is wrong with a scenario, in the package's words; null where it is one. */
  fault(scenario) {
    try {
      return this.row(scenario) && null;
    } catch (problem) {
      if (problem instanceof EngineError) return problem.message;
      throw problem;
    }
  }

  /** A scenario as a row of numbers; what is none is an EngineError. */
  row(given) {
    const { fields } = this.about, scenario = spun(given), wrong = problems(scenario, fields);
    if (wrong.length) {
      const others = [...new Set(wrong.slice(1).map(({ shown }) => shown))];
      throw new EngineError(wrong[0].message + (others.length ? ` (also wrong: ${others.join(", ")})` : ""));
    }
    const row = Float64Array.from(fields, ({ name, words, default: missing }) => {
      const value = scenario[name] ?? missing ?? listed(scenario, name);
      return words ? Number(Object.keys(words).find((code) => words[code] === value)) : value ?? NaN;
    });
    const { fault } = this.#examine(row);
    const found = this.about.faults[fault];
    if (found) throw new EngineError(faultText(found, this.#examine(row).limit, scenario, fields));
    return row;
  }

  /** Toss many scenarios that differ in some fields; see engine.d.ts. */
  tossEach(scenario, changes, wanted = "outcome") {
    const columns = Object.entries(changes), count = columns[0]?.[1].length;
    if (count === undefined || columns.some(([, values]) => values.length !== count))
      throw new EngineError("changes: accepted: lists of one length, by the fields that they change");
    const first = Object.fromEntries(columns.map(([field, values]) => [field, values[0]]));
    const base = count ? this.row(changed(scenario, first)) : [];
    const places = columns.map(([field, values]) => ({ at: this.#place(field), whole: this.about.fields[this.#place(field)].whole, values }));
    return this.#each(count, base, (row, i) => {
      for (const { at, whole, values } of places) row[at] = whole ? Math.trunc(values[i]) : values[i];
    }, wanted);
  }

  /** The mapped outcomes of some pixels, each at a value of x and one of y, and the milliseconds taken: for workers; see workers.js. */
  tossPixels({ row, x, y, after, trust }) {
    const start = performance.now(), max = this.#place("ending.max_impacts"), base = Float64Array.from(row);
    if (after !== null) base[max] = Math.min(after + 1, base[max] || Infinity);
    const wanted = trust ? (after === null ? "certain" : "trust") : "outcome";
    const parts = directed(SPINS.map((field) => base[this.#place(field)]));
    const columns = [x, y].flatMap(({ field, values }) => (field === SPIN
      ? SPINS.map((each, i) => [this.#place(each), values.map((value) => value * parts[i])]) : [[this.#place(field), this.#within(field, values)]]));
    const found = this.#each(x.values.length, base, (made, i) => {
      for (const [at, values] of columns) made[at] = values[i];
    }, wanted);
    const { outcome, impacts, lastFace, trustedImpacts, outcomeCertain } = found;
    const isTouch = (i) => after !== null && impacts[i] > after;
    return {
      codes: outcome.map((code, i) => (isTouch(i) ? lastFace[i] : code)),
      trusted: trust ? outcome.map((_, i) => Number(after === null ? outcomeCertain[i] === 1 : trustedImpacts[i] > after)) : null,
      time: performance.now() - start,
    };
  }

  // Values of a field, infinite where its bounds do not have them.
  #within(field, values) {
    const { least, most } = this.about.fields[this.#place(field)];
    return values.map((value) => (value < (least ?? -Infinity) || value > (most ?? Infinity) ? Infinity : value));
  }

  /** Toss a coin and keep its impacts and its path; see engine.d.ts. */
  toss(scenario) {
    const { answer: names, impact, piece } = this.about, wide = impact.length, row = this.row(scenario);
    for (let room = ROOM; ; ) {
      const { impacts: most, pieces: length } = room;
      const found = this.#run([row, names.length, most * wide, length * piece, 2], (at, call) => {
        call("toss_one", line(at[0], row.length), line(at[1], names.length), table(at[2], most, wide), table(at[3], length, piece), line(at[4], 2));
        const [impacts, pieces] = this.#read(at[4], 2);
        if (impacts > most || pieces > length) return { impacts, pieces };
        return { answer: this.#read(at[1], names.length), hits: this.#read(at[2], impacts * wide), path: this.#read(at[3], pieces * piece) };
      });
      if (found.answer) return this.#told(row, found);
      room = found;
    }
  }

  #told(row, { answer, hits, path }) {
    const of = (name) => answer[this.about.answer.indexOf(name)], wide = this.about.impact.length;
    const impacts = Array.from({ length: hits.length / wide }, (_, i) => {
      const [time, face, energy, ...impulse] = hits.subarray(i * wide, (i + 1) * wide);
      return { time, face: face === 1 ? "H" : "T", energy, impulse };
    });
    const [ending, sentence] = this.about.endings[of("ending")], at = (field) => row[this.#place(field)];
    return {
      outcome: this.about.outcomes[of("outcome")], ending, sentence, endTime: of("end_time"),
      pathEnd: path[path.length - this.about.piece], laterTimes: bouncesAfter(of("end_time"), path, this.about.piece),
      impacts, sequence: impacts.map(({ face }) => face).join(""),
      trustedImpacts: of("trusted_impacts"), outcomeCertain: of("outcome_certain") === 1,
      coin: {
        radius: at("coin.radius"), thickness: at("coin.thickness"), center: ["xi", "eta", "zeta"].map((axis) => at(`coin.center_of_mass.${axis}`)),
        barrier: this.#examine(row).barrier,
      },
      path: (times) => this.#sample(row, path, times),
    };
  }

  #sample(row, path, times) {
    const { piece } = this.about, count = times.length, end = path[path.length - piece];
    for (let i = 0; i < count; i++)
      if (!(times[i] >= (i ? times[i - 1] : 0) && times[i] <= end))
        throw new EngineError(`times: ${times[i]} at ${i}; accepted: increasing from 0 to ${end} s`);
    return this.#run([row, path, times, count * STATE, count * 4], (at, call) => {
      call("sample_path", line(at[0], row.length), table(at[1], path.length / piece, piece), line(at[2], count), table(at[3], count, STATE), table(at[4], count, 4));
      const more = this.#read(at[4], count * 4);
      return { states: this.#read(at[3], count * STATE), energies: more.filter((_, i) => i % 4 === 0), forces: more.filter((_, i) => i % 4 !== 0) };
    });
  }

  #examine(row) {
    const { examined } = this.about;
    return this.#run([row, examined.length], ([given, told], call) => {
      call("examine", line(given, row.length), line(told, examined.length));
      return Object.fromEntries([...this.#read(told, examined.length)].map((number, i) => [examined[i], number]));
    });
  }

  // Tosses of many copies of a row, each of which `change` changes.
  #each(count, base, change, wanted) {
    const level = WANTED.indexOf(wanted), names = this.about.answer, wide = names.length;
    if (level < 0) throw new EngineError(`wanted: ${wanted}; accepted: ${WANTED.join(", ")}`);
    const answers = new Float64Array(count * wide);
    for (let start = 0; start < count; start += AT_ONCE) {
      const length = Math.min(AT_ONCE, count - start), rows = new Float64Array(length * base.length);
      for (let i = 0; i < length; i++) {
        const row = rows.subarray(i * base.length, (i + 1) * base.length);
        row.set(base);
        change(row, start + i);
      }
      answers.set(this.#run([rows, length * wide], ([given, told], call) => {
        call("toss_each", table(given, length, base.length), [level], table(told, length, wide));
        return this.#read(told, length * wide);
      }), start * wide);
    }
    const column = (name, Kind) => Kind.from({ length: count }, (_, i) => answers[i * wide + names.indexOf(name)]);
    return {
      outcome: column("outcome", Int8Array), ending: column("ending", Int8Array), impacts: column("impacts", Int32Array),
      lastFace: column("last_face", Int8Array), endTime: column("end_time", Float64Array),
      trustedImpacts: level > 0 ? column("trusted_impacts", Int32Array) : null,
      outcomeCertain: level > 1 ? column("outcome_certain", Int8Array) : null,
    };
  }

  #place(field) {
    const place = this.places.get(field);
    if (place === undefined || this.about.fields[place].words) throw new EngineError(`${field}: accepted: a field that is a number`);
    return place;
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

/** A scenario in which the components of the angular velocity have the size "release.spin", if it is given, about their own axis. */
export function spun(scenario) {
  if (scenario?.[SPIN] === undefined) return scenario;
  const { [SPIN]: size, ...others } = scenario, parts = directed(SPINS.map((field) => others[field] ?? 0));
  return { ...others, ...Object.fromEntries(SPINS.map((field, i) => [field, size * parts[i]])) };
}

const directed = (parts) => parts.map((part) => part / Math.hypot(...parts));

/** A scenario with other values of some fields; the angles and the quaternion of a release take the place of each other. */
export function changed(scenario, values) {
  const made = { ...scenario, ...values }, other = { "release.angles": "release.quaternion", "release.quaternion": "release.angles" };
  for (const list of new Set(Object.keys(values).map(listOf)))
    for (const name of Object.keys(scenario)) if (other[list] && listOf(name) === other[list]) delete made[name];
  return made;
}

// The times after the end of a toss at which a flight follows a flight: the coin touches and bounces.
function bouncesAfter(end, path, wide) {
  return Array.from({ length: path.length / wide }, (_, i) => ({ time: path[i * wide], flies: path[i * wide + 1] === 0 })).filter(({ time, flies }, i, starts) => time > end && flies && starts[i - 1].flies).map(({ time }) => time);
}

// An array of numbers as the engine takes it: its size, the bytes of a number, its place, shape and strides.
const line = (address, length) => [0, 0, length, WORD, address, length, WORD];
const table = (address, rows, columns) => [0, 0, rows * columns, WORD, address, rows, columns, columns * WORD, WORD];

const listOf = (name) => Object.keys(LISTS).find((list) => name.startsWith(`${list}.`));

// What stands for a missing entry of a list that is given: null for nothing.
function listed(scenario, name) {
  const list = listOf(name);
  return list === "release.angles" && !Object.keys(scenario).some((key) => listOf(key) === "release.quaternion") ? LISTS[list] : null;
}

// What is wrong with the fields of a scenario, each for itself, in the package's words.
function problems(scenario, fields) {
  if (typeof scenario !== "object" || scenario === null) return [{ shown: "", message: "scenario: accepted: an object of its fields" }];
  const names = fields.map(({ name }) => name), wrong = [];
  for (const name of Object.keys(scenario)) {
    if (names.includes(name)) continue;
    const table = name.slice(0, name.lastIndexOf(".") + 1), known = names.filter((each) => each.startsWith(table) && table).map((each) => each.slice(table.length));
    wrong.push({ shown: name, message: `${name} = ${written(scenario[name])}: unknown key; accepted: ${(known.length ? known : ["gravity", "coin", "air", "floor", "release", "ending"]).join(", ")}` });
  }
  for (const { name, shown, words, whole, least, most, accepted } of fields) {
    const value = scenario[name] ?? null, refuse = (why) => wrong.push({ shown, message: `${shown} = ${written(value)}: accepted: ${accepted[why]}` });
    if (value === null) {
      const path = shown.replace(/\[.*/, "");
      if (accepted.missing && !wrong.some((one) => one.shown === path)) wrong.push({ shown: path, message: `${path}: missing; accepted: ${accepted.missing}` });
    } else if (words ? !Object.values(words).includes(value) : typeof value !== "number") refuse("type");
    else if (!words && !Number.isFinite(value)) refuse("finite");
    else if (whole && !Number.isInteger(value)) refuse("type");
    else if ((least !== null && value < least) || (most !== null && value > most)) refuse("bounds");
  }
  const entries = (list) => names.filter((name) => listOf(name) === list), given = (list) => entries(list).filter((name) => (scenario[name] ?? null) !== null);
  if (given("release.angles").length && given("release.quaternion").length) {
    const value = entries("release.quaternion").map((name) => written(scenario[name] ?? 0));
    wrong.push({ shown: "release.quaternion", message: `release.quaternion = [${value.join(", ")}]: accepted: either angles or quaternion, not both` });
  }
  for (const [list, missing] of Object.entries(LISTS))
    if (missing === null && given(list).length && given(list).length < entries(list).length)
      wrong.push({ shown: list, message: `${list}: accepted: all its ${entries(list).length} numbers, or none` });
  return wrong;
}

// A number or a text as Python writes it.
function written(value, isFloat = false) {
  if (typeof value === "string") return `"${value}"`;
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value !== "number") return String(value);
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
  const [digits, power] = value.toExponential().split("e").map((part, i) => (i ? Number(part) : part));
  if (value !== 0 && (power < -4 || power >= 16)) return exponent(digits, power);
  return Number.isInteger(value) && isFloat ? `${value}.0` : String(value);
}

const exponent = (digits, power) => `${digits}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;

// A number with so many significant digits, as Python's format "g" writes it.
function general(value, digits) {
  if (!Number.isFinite(value)) return written(value);
  const [mantissa, power] = value.toExponential(digits - 1).split("e").map((part, i) => (i ? Number(part) : part));
  const short = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
  return power < -4 || power >= digits ? exponent(short(mantissa), power) : short(value.toFixed(Math.max(digits - 1 - power, 0)));
}

// The sentence of a fault that only several fields show together.
function faultText([field, accepted], limit, scenario, fields) {
  const of = (path) => fields.filter(({ name }) => name === path || name.startsWith(`${path}.`)), value = ({ name, default: missing }) => scenario[name] ?? missing;
  const number = (one) => written(value(one), true), found = of(field);
  const lists = (list) => `(${of(list).map(number).join(", ")})`;
  const part = () => {
    const keys = [...new Set(found.map(({ name }) => name.split(".")[1]))].filter((key) => of(`${field}.${key}`).some((one) => (value(one) ?? null) !== null));
    return `{${keys.map((key) => `'${key}': ${of(`${field}.${key}`).length > 1 ? lists(`${field}.${key}`) : number(of(`${field}.${key}`)[0])}`).join(", ")}}`;
  };
  const list = (some) => `[${some.map(number).join(", ")}]`, rows = [0, 3, 6].map((start) => list(found.slice(start, start + 3)));
  const text = found.length === 1 ? number(found[0]) : found.length === 9 && field.includes(".") ? `[${rows.join(", ")}]` : field.includes(".") ? list(found) : part();
  const sentence = accepted.replace("{limit:.6g}", general(limit, 6)).replace("{limit:.3g}", general(limit, 3)).replace("{limit}", written(limit, true)).replace("{contact}", scenario["floor.contact"]);
  return `${field} = ${text.length <= 80 ? text : `${text.slice(0, 77)}...`}: accepted: ${sentence}`;
}

// In a worker it answers what workers.js asks.
const NAME = "cointoss engine";
if (typeof WorkerGlobalScope !== "undefined" && self.name === NAME) {
  let engine = null;
  const answers = {
    load: async (bytes) => (engine = await load(bytes)).about.version,
    pixels: (some) => engine.tossPixels(some),
    each: (scenario, changes, wanted) => engine.tossEach(scenario, changes, wanted),
    played: (scenario, samples) => played(engine.toss(scenario), samples),
  };
  self.onmessage = async ({ data: { method, given } }) => {
    try {
      self.postMessage({ answer: await answers[method](...given) });
    } catch (problem) {
      self.postMessage({ problem: problem instanceof EngineError ? problem.message : `the engine failed: ${problem.message}` });
    }
  };
}

/** A worker that runs this very module. */
export const startWorker = () => new Worker(import.meta.url, { type: "module", name: NAME });

/** A toss as the scripts of a page play it, with its path at evenly spread times, and on both sides of its first impacts. */
export function played(toss, samples) {
  const { impacts, endTime, pathEnd, laterTimes } = toss, most = Math.floor(samples / 4), shown = impacts.slice(0, most), later = laterTimes.slice(0, most - shown.length);
  const even = Array.from({ length: samples }, (_, i) => (i * pathEnd) / (samples - 1)), hits = [...shown.map(({ time }) => time), ...later].flatMap((time) => [time * (1 - 2 ** -52), time]);
  const times = [...new Set([...even, ...hits, pathEnd])].filter((time) => time <= pathEnd).sort((a, b) => a - b);
  const { states, energies } = toss.path(times), part = (first, count) => times.flatMap((_, i) => [...states.subarray(13 * i + first, 13 * i + first + count)]);
  return {
    engine: "analytic", outcome: toss.outcome, certain: toss.outcomeCertain, ending: toss.sentence, end_time: endTime, count: impacts.length,
    sequence: toss.sequence.slice(0, shown.length), times: shown.map(({ time }) => time), trusted: toss.trustedImpacts, notes: [], coin: toss.coin,
    path: { time: times, position: part(0, 3), quaternion: part(6, 4), energy: [...energies] },
    ...(pathEnd > endTime ? { later_times: later } : {}),
  };
}
