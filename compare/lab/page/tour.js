// The guided tour: eight stops, each a state of the lab with a few sentences on what it shows.

import { element } from "./elements.js";

const COIN = { "coin.mass": 0.002, "coin.radius": 0.0125, "coin.thickness": 0.002 };
const ASIDE = { "coin.center_of_mass.xi": -0.001, "coin.center_of_mass.eta": -0.001, "coin.center_of_mass.zeta": -0.0002 };
const AIR = { "air.normal": 0.8, "air.tangential": 0.2 };
const FLOOR = { "floor.restitution": 0.8, "floor.contact": "smooth" };
const PLACE = { "release.position.x": 0, "release.position.y": 0 };
const FALL = { ...PLACE, "release.position.z": 0.4, "release.angular_velocity.eta": 45 };
const SPIN = ["release.angular_velocity.eta", 20, 60], HEIGHT = ["release.position.z", 0.2, 0.6];
const THROWN = { ...PLACE, "release.position.z": 1, "release.velocity.z": 2, "release.angular_velocity.eta": 40, "ending.caught": 1 };

// Name, title, sentences, axes across and up, impacts before the touch that is mapped, scenario, and what else is other.
const TOLD = [
  ["caught", "Caught", "Not if you catch it. A coin that is caught where it was released shows the face that its turns decide: " +
    "their number is spin times speed upwards over π times gravity, from a sixth of a turn at the lower left to 9.7 at the upper right. " +
    "So heads and tails lie in bands between hyperbolas, and the same throw always gives the same face. Throw it: can you land three heads in a row?",
    ["release.angular_velocity.eta", 10, 100], ["release.velocity.z", 0.5, 3], null, { ...COIN, "coin.thickness": 0, ...FLOOR, ...THROWN }],
  ["touch", "One touch", "Now it falls onto a floor. At the first touch the face changes 3 to 5 times along a row of the map. " +
    "The stripes are wide: a hand whose height and spin scatter by 2 %, one standard deviation, keeps the face in more than 999 of 1,000 tosses.", SPIN, HEIGHT, 0, { ...COIN, ...FLOOR, ...FALL }],
  ["bounces", "A bounce", "At the second touch, after a single bounce, the face changes hundreds of times along a row, more often than the map can draw. " +
    "A bounce turns a small difference into a large one. The stripes are still there, only thinner: press + six times, and see them apart.",
    SPIN, HEIGHT, 1, { ...COIN, ...FLOOR, ...FALL, "release.angular_velocity.eta": 50 }],
  ["hundred", "A hundred coins", "A hundred coins are released together. Each spin is off by a millionth at most. All show the same face up to touch 5, and part at touch 6. " +
    "Make the hair a thousand times thinner: they part only one touch later, at a billionth of a millionth never, for there the numbers of the computer end.",
    SPIN, HEIGHT, 2, { ...COIN, ...FLOOR, ...FALL }, { hair: 1e-6 }],
  ["restitution", "A softer floor", "The final face, over the restitution χ of the floor: the part of its speed that a bounce gives back. On a floor that gives nothing back the face changes " +
    "a dozen times or so along the row. At 0.3 it changes more than a hundred times, more often than the map can draw.",
    SPIN, ["floor.restitution", 0, 0.9], null, { ...COIN, ...FLOOR, ...FALL, "floor.restitution": 0.3 }],
  ["air", "Air", "The face at the third touch, in air. Air slows the coin by little, and still a third of the tosses show another face than in vacuum. " +
    "Untick the air under Floor and air, and see the stripes move.", SPIN, HEIGHT, 2, { ...COIN, ...AIR, ...FLOOR, ...FALL }],
  ["imperfect", "An imperfect coin", "The mass centre of this coin lies 1.4 mm aside: the pink pin. At the first touch one toss in thirty shows another face " +
    "than that of the perfect coin, at the third touch, shown here, nearly a third of them.", SPIN, HEIGHT, 2, { ...COIN, ...ASIDE, ...AIR, ...FLOOR, ...FALL }],
  ["hand", "A hand", "The height and spin of this hand scatter by 2 %, one standard deviation: the dashed ellipse. In the end it holds tosses of both faces side by side, " +
    "so heads come in about half of its tosses. Choose face at touch 1 under Map: there nearly all of its tosses still show heads. Nothing here is random but the hand: so the answer is no, and yes.",
    ["release.angular_velocity.eta", 25.25, 28.75], ["release.position.z", 0.375, 0.425], null, { ...COIN, ...AIR, ...FLOOR, ...FALL, "release.angular_velocity.eta": 27 }, { hand: 0.02 }],
];

// The stops that an address of an earlier release names by their numbers.
const NUMBERED = ["caught", "bounces", "restitution", "air", "imperfect", "hand"];

export const STOPS = TOLD.map(([name, title, text, x, y, after, scenario, more = {}]) => {
  const axis = ([field, from, to]) => ({ field, from, to });
  return { name, title, text, state: { x: axis(x), y: axis(y), after, scenario, hand: null, hair: null, trust: false, before: null, tour: name, ...more } };
});
export const NAMES = STOPS.map(({ name }) => name);

export const stopNamed = (text) => (/^[1-6]$/.test(text) ? NUMBERED[Number(text) - 1] : text);

// Fills a list with links to the stops, and has `go` called with the state of the one that is wanted; returns what
// shows the stop of a state, or none. `link` is the address of a state.
export function makeTour({ list, box, back, next }, link, go) {
  let stands = null, at = -1;
  const links = STOPS.map(({ title, state }, i) => {
    const item = element("li"), to = element("a", "", String(i + 1));
    to.href = link(state);
    to.title = title;
    to.setAttribute("aria-label", `${i + 1}. ${title}`);
    item.append(to);
    list.append(item);
    return to;
  });
  // Another tab, or a link that is copied, has the address.
  links.forEach((to, i) => to.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    go(STOPS[i].state);
  }));
  back.addEventListener("click", () => go(STOPS[Math.max(at - 1, 0)].state));
  next.addEventListener("click", () => go(STOPS[Math.min(at + 1, STOPS.length - 1)].state));

  return (state, isOnTheWay = false) => {
    at = NAMES.indexOf(state.tour);
    const stop = STOPS[at] ?? null, isOther = stop !== null && !isOnTheWay && shown(stop.state) !== shown(state), now = `${state.tour} ${isOther}`;
    if (now === stands) return;
    stands = now;
    links.forEach((to, i) => (i === at ? to.setAttribute("aria-current", "step") : to.removeAttribute("aria-current")));
    back.disabled = at <= 0;
    next.disabled = at === STOPS.length - 1;
    box.hidden = stop === null;
    box.replaceChildren(...(stop ? [element("b", "", `${at + 1}. ${stop.title}. `), stop.text] : []));
    if (!isOther) return;
    const return_ = element("a", "", "Back to this stop");
    return_.href = link(stop.state);
    box.append(" You have changed something. ", return_, ".");
  };
}

// What the sentences of a stop speak of.
function shown({ scenario, x, y, after, hand, hair }) {
  const own = Object.entries(scenario).filter(([field]) => field !== x.field && field !== y.field);
  return JSON.stringify([own.sort(), x, y, after, hand, hair]);
}
