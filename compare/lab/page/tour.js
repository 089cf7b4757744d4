// The guided tour: six stops, each a state of the lab with a few sentences on its map.

const COIN = { "coin.mass": 0.002, "coin.radius": 0.0125, "coin.thickness": 0.002 };
const ASIDE = { "coin.center_of_mass.xi": -0.001, "coin.center_of_mass.eta": -0.001, "coin.center_of_mass.zeta": -0.0002 };
const AIR = { "air.normal": 0.8, "air.tangential": 0.2 };
const FLOOR = { "floor.restitution": 0.8, "floor.contact": "smooth" };
const PLACE = { "release.position.x": 0, "release.position.y": 0 };
const FALL = { ...PLACE, "release.position.z": 0.4, "release.angular_velocity.eta": 45 };
const SPIN = ["release.angular_velocity.eta", 20, 60], HEIGHT = ["release.position.z", 0.2, 0.6];

const STATES = [
  [["release.angular_velocity.eta", 10, 100], ["release.velocity.z", 0.5, 3], null,
    { ...COIN, "coin.thickness": 0, ...FLOOR, ...PLACE, "release.position.z": 1, "release.velocity.z": 2, "release.angular_velocity.eta": 40, "ending.caught": 1 }],
  [SPIN, HEIGHT, 1, { ...COIN, ...FLOOR, ...FALL }],
  [SPIN, ["floor.restitution", 0, 0.9], null, { ...COIN, ...FLOOR, ...FALL, "floor.restitution": 0.3 }],
  [SPIN, HEIGHT, 2, { ...COIN, ...AIR, ...FLOOR, ...FALL }],
  [SPIN, HEIGHT, 2, { ...COIN, ...ASIDE, ...AIR, ...FLOOR, ...FALL }],
  [SPIN, HEIGHT, 0, { ...COIN, ...AIR, ...FLOOR, ...FALL, "release.angular_velocity.eta": 27 }, 0.02],
];

const TEXTS = [
  ["Keller's hyperbolas", "A thin coin turns in vacuum and is caught where it was released. The face in the hand depends on the number of turns alone, " +
    "spin times speed over π g: from a sixth of a turn at the lower left to 9.7 turns at the upper right. So the boundaries are hyperbolas. " +
    "Twice the speed with half the spin gives the same face."],
  ["Bounces", "The same fall onto a floor. At the first touch the face changes 3 to 5 times along a row of the map; choose it under Map. " +
    "At the second touch, shown here, it changes more than a hundred times: a bounce amplifies small differences. Zoom in to see the stripes apart."],
  ["Restitution", "The final face, over the floor's restitution from 0 to 0.9. On a floor that gives nothing back the face changes a dozen times or so along the row. " +
    "At 0.3 it changes more than a hundred times, and at 0.6 more often than the map has columns."],
  ["Air", "The face at the third touch, in air. Air slows the coin by little, and still a third of the pixels have another face than in vacuum. " +
    "Untick the air under Floor, and see the stripes move."],
  ["The imperfect coin", "The mass centre of this coin lies 1.4 mm aside: the pink pin. At the first touch one pixel in thirty has another face " +
    "than that of the perfect coin, at the third touch, shown here, nearly a third of them."],
  ["The hand", "A hand repeats height and spin within 2 %: the ellipse. At the first touch the stripes are wider than that, and nearly all of its tosses are heads. " +
    "Choose touch 3 under Map: the ellipse reaches over stripes of both faces, and heads come in about half. This is what makes a toss a gamble."],
];

export const STOPS = STATES.map(([x, y, after, scenario, hand = null], i) => {
  const axis = ([field, from, to]) => ({ field, from, to }), [title, text] = TEXTS[i];
  return { title, text, state: { x: axis(x), y: axis(y), after, scenario, hand, trust: false, before: null, tour: i + 1 } };
});

// Fills a list with links to the stops; returns what shows the stop of a state, or none.
export function makeTour(list, box, link) {
  const links = STOPS.map(({ title, state }, i) => {
    const item = document.createElement("li"), to = document.createElement("a");
    to.href = link(state);
    to.textContent = `${i + 1}. ${title}`;
    item.append(to);
    list.append(item);
    return to;
  });
  let stands = null;
  return (state) => {
    const stop = STOPS[state.tour - 1] ?? null, isOther = stop !== null && mapped(stop.state) !== mapped(state), now = `${state.tour} ${isOther}`;
    if (now === stands) return;
    stands = now;
    links.forEach((to, i) => (STOPS[i] === stop ? to.setAttribute("aria-current", "step") : to.removeAttribute("aria-current")));
    box.hidden = stop === null;
    box.textContent = stop?.text ?? "";
    if (!isOther) return;
    const back = document.createElement("a");
    back.href = link(stop.state);
    back.textContent = "Back to this stop";
    box.append(" You have changed the map. ", back, ".");
  };
}

// What the sentences of a stop speak of.
function mapped({ scenario, x, y, after, hand }) {
  const own = Object.entries(scenario).filter(([field]) => field !== x.field && field !== y.field);
  return JSON.stringify([own.sort(), x, y, after, hand]);
}
