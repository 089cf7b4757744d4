/** The analytic engine in a page; all numbers in SI. */

/** What is found beside the outcome of many tosses: nothing, the trusted impacts, and whether it is certain, too. */
export type Wanted = "outcome" | "trust" | "certain";

/** How many tosses ended, an entry each. */
export interface Outcomes {
  /** Numbers of `Engine.about.outcomes`. */
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

export interface Toss {
  outcome: string;
  ending: string;
  /** What the ending means. */
  sentence: string;
  /** [s] */
  endTime: number;
  impacts: Impact[];
  /** The faces up at the touches, as in "HHT". */
  sequence: string;
  /** How many leading impacts the engine's own errors cannot have changed. */
  trustedImpacts: number;
  /** Whether they cannot change the outcome. */
  outcomeCertain: boolean;
  /** Sample the path at increasing times, from 0 to `endTime`; others are an EngineError. */
  path(times: ArrayLike<number>): Path;
}

/** What went wrong, in a line. */
export class EngineError extends Error {}

export class Engine {
  /** What made engine.wasm, and what its numbers mean. */
  readonly about: {
    version: string;
    sources: string;
    /** How many numbers a scenario has, and which of them may be infinite, or null. */
    numbers: number;
    endless: number[];
    answer: string[];
    impact: string[];
    piece: number;
    outcomes: Record<number, string>;
    endings: Record<number, [string, string]>;
  };

  /** Bytes of memory that the engine holds. */
  readonly memory: number;

  /**
   * Toss a coin once from each release.
   * @param numbers of the scenario: `numbers_of` in Python
   * @param releases states at time 0: position, velocity, Euler parameters, spin in the body frame, 13 numbers each
   * @throws EngineError for what is not accepted, and where memory is refused
   */
  tossEach(numbers: ArrayLike<number | null>, releases: ArrayLike<number>, wanted?: Wanted): Outcomes;

  /** Toss a coin and keep its impacts and its path; the release is 13 numbers. */
  toss(numbers: ArrayLike<number | null>, release: ArrayLike<number>): Toss;
}

/**
 * Load engine.wasm.
 * @param version that it must be of, if given
 * @throws EngineError without WebAssembly, for another file, and for another version
 */
export function load(bytes: BufferSource, version?: string): Promise<Engine>;
