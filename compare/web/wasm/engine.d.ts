/** The analytic engine in a page; all numbers in SI. */

/**
 * A scenario as an object of its fields: { "coin.radius": 0.0125, "floor.contact": "smooth", "release.position.z": 0.4, ... }.
 * A field that is missing has its default; `Engine.about.fields` lists them all.
 */
export type Scenario = Record<string, number | string>;

/** What is found beside the outcome of many tosses: nothing, the trusted impacts, and whether it is certain, too. */
export type Wanted = "outcome" | "trust" | "certain";

/** An axis of a map: a field that is a number, and its values, evenly spread, both ends included. */
export interface Axis {
  field: string;
  start: number;
  stop: number;
  count: number;
}

/** How many tosses ended, an entry each. */
export interface Outcomes {
  /** Numbers of `Engine.about.outcomes`; -2 for what is no scenario. */
  outcome: Int8Array;
  /** Numbers of `Engine.about.endings`. */
  ending: Int8Array;
  impacts: Int32Array;
  /** The face up at the last touch: 1 heads, 2 tails, 0 where there was none. */
  lastFace: Int8Array;
  /** [s] */
  endTime: Float64Array;
  /** How many leading impacts can be trusted; null where that was not asked for. */
  trustedImpacts: Int32Array | null;
  /** 1 where the engine's own errors cannot change the outcome, else 0; null where that was not asked for. */
  outcomeCertain: Int8Array | null;
}

export interface Impact {
  /** [s] */
  time: number;
  /** The face up. */
  face: "H" | "T";
  /** After the impact [J]. */
  energy: number;
  /** Of the floor, space frame [N s]. */
  impulse: number[];
}

export interface Path {
  /** Position of the mass centre, velocity, Euler parameters and spin in the body frame, 13 numbers a time. */
  states: Float64Array;
  /** [J] */
  energies: Float64Array;
  /** The floor's force in sustained contacts, space frame, zero in flight, 3 numbers a time [N]. */
  forces: Float64Array;
}

/** What a page draws of a coin. */
export interface Coin {
  /** [m] */
  radius: number;
  /** [m] */
  thickness: number;
  /** The mass centre from the geometric centre, body frame [m]. */
  center: number[];
  /** The least energy with which it turns over [J]. */
  barrier: number;
}

export interface Toss {
  outcome: string;
  ending: string;
  /** What the ending means. */
  sentence: string;
  /** [s] */
  endTime: number;
  /** The time at which the path ends: endTime, or with `ending.until` later [s]. */
  pathEnd: number;
  /** The times after endTime at which the coin touches and bounces [s]. */
  laterTimes: number[];
  impacts: Impact[];
  /** The faces up at the touches, as in "HHT". */
  sequence: string;
  /** How many leading impacts the engine's own errors cannot have changed. */
  trustedImpacts: number;
  /** Whether they cannot change the outcome. */
  outcomeCertain: boolean;
  coin: Coin;
  /** Sample the path at increasing times, from 0 to `pathEnd`; others are an EngineError. */
  path(times: ArrayLike<number>): Path;
}

/** A toss as the scripts of a page play it; its path has times [s], positions [m], Euler parameters and energies [J]. */
export interface PlayedToss {
  engine: "analytic";
  outcome: string;
  certain: boolean;
  /** What its ending means. */
  ending: string;
  end_time: number;
  /** Of all impacts; the sequence and the times are those of the first. */
  count: number;
  sequence: string;
  times: number[];
  trusted: number;
  notes: string[];
  coin: Coin;
  /** Where the path goes on after end_time: the times of the first touches there. */
  later_times?: number[];
  path: { time: number[]; position: number[]; quaternion: number[]; energy: number[] };
}

/** What went wrong, in a line. */
export class EngineError extends Error {}

/** What a page has to know of a field. */
export interface Field {
  name: string;
  /** As messages name it. */
  shown: string;
  /** What a person calls it. */
  word: string;
  unit: string;
  /** Null for none. */
  default: number | string | null;
  /** By their numbers, where it is a word. */
  words: Record<number, string> | null;
  /** Whether it is a whole number. */
  whole: boolean;
  /** The ends of its range. */
  least: number | null;
  most: number | null;
  /** What is accepted, where it is missing, of another type, not finite or out of range. */
  accepted: Partial<Record<"missing" | "type" | "finite" | "bounds", string>>;
}

/** The engine in the page itself: a call returns when all is tossed. */
export class Engine {
  /** What made engine.wasm, and what its numbers mean. */
  readonly about: {
    version: string;
    sources: string;
    fields: Field[];
    /** The field that each fault names, and what is accepted there. */
    faults: Record<number, [string, string]>;
    answer: string[];
    examined: string[];
    impact: string[];
    piece: number;
    outcomes: Record<number, string>;
    endings: Record<number, [string, string]>;
  };

  /** Bytes of memory that the engine holds. */
  readonly memory: number;

  /** What is wrong with a scenario, as the package says it; null where it is one. */
  fault(scenario: Scenario): string | null;

  /**
   * Toss a coin, and keep its impacts and its path.
   * @throws EngineError for what is no scenario, and where memory is refused
   */
  toss(scenario: Scenario): Toss;

  /**
   * Toss a coin many times, each with other values of some fields.
   * @param changes lists of one length, by the fields that they change
   * @throws EngineError where the scenario of the first values is none, and where memory is refused
   */
  tossEach(scenario: Scenario, changes: Record<string, ArrayLike<number>>, wanted?: Wanted): Outcomes;
}

/** A scenario in which the components of the angular velocity have the size "release.spin", if it is given, about their own axis. */
export function spun(scenario: Scenario): Scenario;

/**
 * A scenario with other values of some fields; the angles and the quaternion of a release take the place of each other.
 */
export function changed(scenario: Scenario, values: Scenario): Scenario;

/**
 * Load engine.wasm.
 * @param version that it must be of, if given
 * @throws EngineError without WebAssembly, for another file, and for another version
 */
export function load(bytes: BufferSource | WebAssembly.Module, version?: string): Promise<Engine>;
