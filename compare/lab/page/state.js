// The state of the lab, and the address that carries it whole.

import { THINNEST, WIDEST } from "./hundred.js";
import { NAMES, STOPS, stopNamed } from "./tour.js";

export const START = {
  x: { field: "release.angular_velocity.eta", from: 20, to: 60 },
  y: { field: "release.position.z", from: 0.2, to: 0.6 },
  after: 1, trust: false, hand: null, hair: null, before: null, tour: null,
};

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const WORD = /^[a-z_]{1,40}$/;
const MOST_TOUCH = 1000;

export class StateError extends Error {}

// What stands after the # of the address: the scenario's fields, but for those at their defaults, and the view.
export function address(state, fields) {
  const found = new URLSearchParams();
  for (const [field, value] of Object.entries(state.scenario)) {
    if (value !== fields[field]?.default) found.set(field, String(value));
  }
  for (const name of ["x", "y"]) found.set(name, `${state[name].field}:${state[name].from}:${state[name].to}`);
  found.set("map", state.after === null ? "final" : String(state.after + 1));
  if (state.trust) found.set("trust", "1");
  if (state.hand !== null) found.set("hand", String(state.hand));
  if (state.hair !== null) found.set("hair", String(state.hair));
  if (state.before) found.set("before", state.before.join(":"));
  if (state.tour !== null) found.set("tour", state.tour);
  return `#${found.toString().replaceAll("%3A", ":")}`;
}

// The state of an address; `fields` are those of a scenario, `fault` says what is wrong with one, or null, and `start` is
// the state of the page. An address that names a stop of the tour and nothing else is that stop.
export function fromAddress(hash, fields, fault, start) {
  const given = new Map(new URLSearchParams(hash.replace(/^#/, "")));
  const taken = (name) => {
    const text = given.get(name);
    given.delete(name);
    return text;
  };
  const tour = taken("tour"), stop = tour === undefined ? null : STOPS.find(({ name }) => name === stopNamed(tour));
  if (stop === undefined) throw new StateError(`tour: ${shortened(tour)}; accepted: ${NAMES.join(", ")}`);
  if (stop && !given.size) return stop.state;
  const state = { ...start, tour: stop && stop.name };
  for (const name of ["x", "y"]) {
    const text = taken(name);
    if (text !== undefined) state[name] = axisOf(name, text, fields);
  }
  if (state.x.field === state.y.field) throw new StateError(`y: ${state.y.field}; accepted: another field than that of x`);
  const map = taken("map"), touch = Number(map);
  if (map === "final") state.after = null;
  else if (map === undefined) state.after = start.after;
  else if (Number.isInteger(touch) && touch >= 1 && touch <= MOST_TOUCH) state.after = touch - 1;
  else throw new StateError(`map: ${shortened(map)}; accepted: final, or the number of a touch from 1 to ${MOST_TOUCH}`);
  state.trust = taken("trust") === "1";
  const hand = taken("hand"), hair = taken("hair"), before = taken("before");
  if (hand !== undefined) state.hand = within("hand", hand, 0, 0.3);
  if (hair !== undefined) state.hair = within("hair", hair, THINNEST, WIDEST);
  if (before !== undefined) {
    state.before = before.split(":").map((text) => within("before", text, -1e9, 1e9));
    if (state.before.length !== 2) throw new StateError(`before: ${shortened(before)}; accepted: two numbers`);
  }
  if (given.size) state.scenario = {};
  for (const [field, text] of given) {
    if (!(field in fields)) throw new StateError(`${shortened(field)}: no field of a scenario`);
    if (!NUMBER.test(text) && !WORD.test(text)) throw new StateError(`${field}: ${shortened(text)}; accepted: a number or a word`);
    state.scenario[field] = NUMBER.test(text) ? Number(text) : text;
  }
  const wrong = fault(state.scenario);
  if (wrong !== null) throw new StateError(wrong);
  return state;
}

function axisOf(name, text, fields) {
  const [field, from, to, ...more] = text.split(":");
  if (more.length || to === undefined || !(field in fields)) throw new StateError(`${name}: ${shortened(text)}; accepted: FIELD:FROM:TO`);
  const axis = { field, from: within(name, from, -1e9, 1e9), to: within(name, to, -1e9, 1e9) };
  if (!(axis.from < axis.to)) throw new StateError(`${name}: ${shortened(text)}; accepted: FROM below TO`);
  return axis;
}

function within(name, text, low, high) {
  const number = Number(text);
  if (!NUMBER.test(text) || !(number >= low && number <= high)) throw new StateError(`${name}: ${shortened(text)}; accepted: a number from ${low} to ${high}`);
  return number;
}

const shortened = (text) => (text.length > 60 ? `${text.slice(0, 60)} …` : text);
