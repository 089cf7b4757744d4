// A map that was made before: its picture, what is known of its pixels, and those that MuJoCo has tossed in the page.

import { indexOf } from "./axes.js";
import { LABELS } from "./motion.js";
import { counted } from "./outcome.js";
import { makePicture } from "./picture.js";

const ELSEWHERE = "tossed only where there is a dot. The analytic engine tosses any pixel here.";

// Returns a picture as of picture.js with its window. `found` is as of saved.py, `tosses` are those of a page without a
// server, `scenario` is the map's; `fields` has their defaults, `outcomes` { color } by code.
export function makeSaved({ axes, arrays, after, margin, ...about }, tosses, scenario, fields, outcomes) {
  const [x, y] = axes.map(({ field, values }) => ({ field, start: values[0], stop: values.at(-1), count: values.length }));
  const layer = (name, Kind) => arrays[name] && new Kind(Uint8Array.from(atob(arrays[name]), (sign) => sign.charCodeAt(0)).buffer);
  const codes = layer("outcome", Int8Array), impacts = layer("impacts", Int32Array), margins = layer("margin", Float32Array);
  const trusts = layer("trusted_impacts", Int32Array), trusted = (trusts ?? layer("outcome_certain", Int8Array))?.map((each) => Number(each > (after ?? 0)));
  const made = makePicture({ x, y, outcomes, trust: Boolean(trusted) });
  made.take({ pixels: Int32Array.from(codes.keys()), codes, trusted, finished: 1 });
  made.isTossed = Uint8Array.from(codes, (code) => Number(code >= 0));
  const tossed = made.isTossed.reduce((sum, each) => sum + each, 0) / codes.length;
  const [across, up] = [x, y].map(({ field, start, stop, count }) => {
    const half = (stop - start) / (count - 1) / 2;
    return { field, from: start - half, to: stop + half };
  });

  // What else than both fields decides a toss.
  const others = (of) => JSON.stringify(Object.entries(of).filter(([field, value]) => field !== x.field && field !== y.field && value !== fields[field]?.default).sort());
  const shows = (state) => state.x.field === x.field && state.y.field === y.field && state.after === after && !(state.trust && !trusted)
    && others(state.scenario) === others(scenario);

  function place(u, v) {
    const [i, j] = [[x, u], [y, v]].map(([axis, value]) => Math.min(Math.max(Math.round(indexOf(axis, value)), 0), axis.count - 1)), at = j * x.count + i;
    return { x: axes[0].values[i], y: axes[1].values[j], code: codes[at], trusted: trusted ? trusted[at] : null, known: pixelText(at) };
  }

  function pixelText(at) {
    if (codes[at] < 0) return "not tossed";
    const trust = trusts ? `, ${trusts[at]} of them trusted` : "";
    return `${counted(impacts[at], "impact")}${trust}${margins && !Number.isNaN(margins[at]) ? `; ${marginText(margins[at], margin)}` : ""}`;
  }

  function aboutText() {
    const shown = after === null ? "the final outcome" : `the face at touch ${after + 1}, or the final face of a toss that ended before`;
    return [
      `${about.name}: ${x.count} by ${y.count} tosses by the ${LABELS[about.engine]} engine: ${shown}.`,
      ...(about.stride > 1 ? [`One pixel of every ${about.stride} along each axis is shown.`] : []),
      ...(tossed < 1 ? [`The map is not finished: ${(100 * tossed).toFixed(1)} % is tossed${tosses ? "" : "; reload to see more"}.`] : []),
      ...(tosses ? ["Any pixel can be tossed by the analytic engine; MuJoCo has tossed those with a dot, and a click near a dot takes it."] : []),
    ].join(" ");
  }

  const isAt = ({ scenario }, { place: [u, v] }) => scenario[x.field] === u && scenario[y.field] === v;
  const [u, v] = tosses ? tosses[tosses.length >> 1].place : [axes[0].values[x.count >> 1], axes[1].values[y.count >> 1]];
  return Object.assign(made, {
    shows, place,
    title: about.title,
    engine: about.engine,
    about: aboutText(),
    isWhole: tossed === 1,
    window: { left: across.from, right: across.to, bottom: up.from, top: up.to },
    // The state that shows all of it, with its middle chosen.
    state: { x: across, y: up, after, trust: Boolean(trusted), scenario: { ...scenario, [x.field]: u, [y.field]: v } },
    dots: (tosses ?? []).map(({ place: [u, v] }) => ({ values: { [x.field]: u, [y.field]: v }, color: "#fff", ring: "#000", size: 3 })),
    // MuJoCo's toss of a state, of those that the page has.
    tossOf: (state) => (shows(state) && tosses.find((each) => isAt(state, each))?.toss) || { engine: "mujoco", problem: ELSEWHERE },
  });
}

function marginText(margin, [along, unit]) {
  if (!Number.isFinite(margin)) return `no change of ${along} up to 1 SI unit was found to change it`;
  return `margin along ${along} ${margin > 0 ? "+" : "−"}${Number(Math.abs(margin).toPrecision(3))} ${unit}`;
}
