/** Many tosses on workers, so that the page goes on meanwhile. */

import type { Axis, Engine, Outcomes, PlayedToss, Scenario, Wanted } from "./engine.js";

/** Some pixels of a map. */
export interface MapPart {
  /** Until finer pixels come, each stands for the square of so many by so many pixels that it lies in. */
  stride: number;
  /** Their numbers, row by row: row * x.count + column. */
  pixels: Int32Array;
  /** Outcomes, or faces at the mapped touch: numbers of `Engine.about.outcomes`; -2 for what is no scenario. */
  codes: Int8Array;
  /** 1 where the engine's own errors cannot change them; null where that was not asked for. */
  trusted: Int8Array | null;
  /** The least stride of whose squares each has a tossed pixel by now; null for none. */
  finished: number | null;
}

export interface MapOptions {
  /** The map shows the face at the touch after so many impacts, or the outcome of a toss that ended before; null for final outcomes. */
  after?: number | null;
  trust?: boolean;
}

/** A map that is asked for. */
export interface MapAsked {
  /** The scenario as the engine takes it, in the order of `Engine.about.fields`; NaN for what is left out. */
  row: Float64Array;
  x: Axis;
  y: Axis;
  after: number | null;
  trust: boolean;
}

export class Workers {
  /** The engine in the page itself. */
  readonly engine: Engine;
  /** Workers that run; 0 where the page itself tosses, part by part. */
  readonly count: number;

  /** Tosses a map in place of the workers, as a server may; null for none. Before a large map a small one of some of its pixels is asked for. */
  tossMap: ((asked: MapAsked, signal?: AbortSignal) => Promise<Pick<MapPart, "codes" | "trusted">>) | null;

  /** Toss a coin, with about so many samples of its path. */
  toss(scenario: Scenario, samples: number): Promise<PlayedToss>;

  /** Toss a coin many times, as `Engine.tossEach`. */
  tossEach(scenario: Scenario, changes: Record<string, ArrayLike<number>>, wanted?: Wanted): Promise<Outcomes>;

  /**
   * Toss a map: some pixels that are spread over it first, as many as take about 60 ms, then those between. Each pixel is tossed once, but by a server.
   * A pixel beyond its field's bounds is answered as no scenario.
   * @param onPart is called with each part
   * @param signal ends it: no further part is tossed, and the promise is rejected with the signal's reason
   */
  map(scenario: Scenario, x: Axis, y: Axis, options: MapOptions, onPart: (part: MapPart) => void, signal?: AbortSignal): Promise<void>;

  /** End the workers. */
  end(): void;
}

/**
 * Load the engine, and start a worker for each core.
 * @throws EngineError as `load` does
 */
export function startWorkers(bytes: BufferSource, version?: string): Promise<Workers>;
