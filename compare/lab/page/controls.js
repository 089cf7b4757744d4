// The controls of the lab: coin, floor, air, release, hand and map, from lists of what each changes.

import { COINS, coinPicture } from "./coins.js";
import { changed } from "./engine.js";
import { THINNEST, WIDEST } from "./hundred.js";
import { element } from "./elements.js";
import { HINTS, LABELS } from "./words.js";

const TURN = 180 / Math.PI;
const TOUCHES = 12; // that are offered

// Sliders in the units that are shown: field, unit, units in one SI unit, least and most.
const SLIDERS = {
  coin: [
    ["coin.radius", "mm", 1e3, 5, 20], ["coin.thickness", "mm", 1e3, 0, 20], ["coin.mass", "g", 1e3, 0.5, 50],
    ["coin.center_of_mass.xi", "mm", 1e3, -3, 3], ["coin.center_of_mass.zeta", "mm", 1e3, -0.5, 0.5],
  ],
  floor: [["floor.restitution", "", 1, 0, 1], ["floor.restitution_exponent", "", 1, 0, 0.5], ["floor.friction", "", 1, 0, 1]],
  release: [
    ["release.position.z", "m", 1, 0.03, 1.5], ["release.velocity.z", "m/s", 1, 0, 4], ["release.angular_velocity.eta", "rad/s", 1, 0, 150],
    ["release.angular_velocity.zeta", "rad/s", 1, 0, 100], ["release.angles.theta", "°", TURN, 0, 90],
  ],
};
const AXES = [...Object.values(SLIDERS).flat().map(([field, , factor, low, high]) => [field, low / factor, high / factor]),
  ["release.velocity.x", 0, 2], ["release.angular_velocity.xi", 0, 150]];
const LAWS = { smooth: "smooth", coulomb: "Coulomb", perfectly_rough: "perfectly rough", knurled: "knurled", sharp_edge: "sharp edge",
  slip_preserving: "slip-preserving", sliding_friction: "sliding friction" };
const AIR = { "air.normal": 0.8, "air.tangential": 0.2 };

// Fills the boxes of the page with controls. `change` is called with what is to be other in the state.
export function makeControls(boxes, fields, change) {
  const shows = [];
  let state = null;
  const scenario = (more) => change({ scenario: changed(state.scenario, more) });
  const value = (field) => state.scenario[field] ?? fields[field]?.default ?? 0;

  function slider(box, name, unit, low, high, read, write, words = (now) => `${Number(now.toPrecision(4))}${unit && (unit === "°" ? unit : `\u00a0${unit}`)}`) {
    const label = element("label", "slider"), output = element("output"), input = Object.assign(element("input"), { type: "range", min: low, max: high, step: "any" });
    label.append(element("span", "", name), input, output);
    input.addEventListener("input", () => write(Number(input.value)));
    shows.push(() => {
      const now = read();
      input.value = String(now);
      output.textContent = words(now);
      input.setAttribute("aria-valuetext", output.textContent);
    });
    box.append(label);
    return input;
  }

  function fieldSlider(box, [field, unit, factor, low, high]) {
    const input = slider(box, LABELS[field], unit, low, high, () => value(field) * factor, (shown) => {
      const caught = field === "release.position.z" && "ending.caught" in state.scenario;
      scenario({ [field]: shown / factor, ...(caught && { "ending.caught": shown / factor }) });
    });
    input.dataset.field = field;
    if (HINTS[field]) input.after(element("small", "soft", HINTS[field]));
  }

  function choice(box, name, options, read, write) {
    const label = element("label", "choice"), select = element("select");
    label.append(element("span", "", name), select);
    select.append(...Object.entries(options).map(([key, text]) => new Option(text, key)));
    select.addEventListener("change", () => write(select.value));
    shows.push(() => {
      const now = String(read());
      if (![...select.options].some((one) => one.value === now)) select.append(new Option(now, now));
      select.value = now;
    });
    box.append(label);
    return select;
  }

  function tick(box, name, read, write) {
    const label = element("label", "tick"), input = Object.assign(element("input"), { type: "checkbox" });
    label.append(input, element("span", "", name));
    input.addEventListener("change", () => write(input.checked));
    shows.push(() => (input.checked = read()));
    box.append(label);
    return input;
  }

  const without = (...names) => change({ scenario: Object.fromEntries(Object.entries(state.scenario).filter(([field]) => !names.includes(field))) });

  const presets = Object.assign(element("div", "presets"), { role: "group", ariaLabel: "Coins" });
  for (const [name, coin] of Object.entries(COINS)) {
    const button = Object.assign(element("button"), { type: "button" });
    button.append(coinPicture(coin), element("span", "", name));
    button.addEventListener("click", () => preset(coin));
    shows.push(() => button.setAttribute("aria-pressed", String(Object.entries(coin).every(([key, each]) => value(`coin.${key}`) === each))));
    presets.append(button);
  }
  boxes.coin.append(presets);

  // Sets a coin as described: with the cylinder's inertia, and its mass centre in the middle.
  function preset(coin) {
    const kept = Object.entries(state.scenario).filter(([field]) => !field.startsWith("coin."));
    change({ scenario: { ...Object.fromEntries(Object.entries(coin).map(([key, each]) => [`coin.${key}`, each])), ...Object.fromEntries(kept) } });
  }

  for (const each of SLIDERS.coin) fieldSlider(boxes.coin, each);
  choice(boxes.floor, "floor", LAWS, () => value("floor.contact"), (law) => scenario({ "floor.contact": law }));
  for (const each of SLIDERS.floor) fieldSlider(boxes.floor, each);
  tick(boxes.floor, "air", () => value("air.normal") > 0 || value("air.tangential") > 0,
    (on) => (on ? scenario(AIR) : without(...Object.keys(AIR), "air.exponent")));
  for (const each of SLIDERS.release) fieldSlider(boxes.release, each);
  tick(boxes.release, "caught by a hand where it was released", () => "ending.caught" in state.scenario,
    (on) => (on ? scenario({ "ending.caught": value("release.position.z") }) : without("ending.caught")));

  const touches = Object.fromEntries(Array.from({ length: TOUCHES }, (_, i) => [i + 1, `face at touch ${i + 1}`]));
  choice(boxes.map, "shows", { ...touches, final: "final face" }, () => (state.after === null ? "final" : state.after + 1),
    (shown) => change({ after: shown === "final" ? null : Number(shown) - 1 })).id = "shows";
  for (const [name, label, other] of [["x", "across", "y"], ["y", "up", "x"]]) {
    choice(boxes.map, label, Object.fromEntries(AXES.map(([field]) => [field, LABELS[field]])), () => state[name].field, (field) => {
      const [, from, to] = AXES.find(([each]) => each === field);
      const swapped = state[other].field === field && { [other]: state[name] };
      change({ [name]: swapped ? state[other] : { field, from, to }, ...swapped, before: null });
    }).id = `across-${name}`;
  }
  tick(boxes.map, "hatch tosses whose face rounding errors may have decided", () => state.trust, (trust) => change({ trust })).id = "trust";
  tick(boxes.hand, "a hand that scatters: 2,000 tosses", () => state.hand !== null, (on) => change({ hand: on ? 0.02 : null })).id = "hand";
  const scatter = slider(boxes.hand, "standard deviation of height, speed and spin", "%", 0.1, 20, () => 100 * (state.hand ?? 0.02), (percent) => change({ hand: percent / 100 }));
  shows.push(() => (scatter.disabled = state.hand === null));
  tick(boxes.hand, "a hundred coins, released a hair apart", () => state.hair !== null, (on) => change({ hair: on ? 1e-6 : null })).id = "hair";
  const hair = slider(boxes.hair, "the hair, as a part of the spin", "", Math.log10(THINNEST), Math.log10(WIDEST), () => Math.log10(state.hair ?? 1e-6),
    (power) => change({ hair: Math.min(Math.max(Number((10 ** power).toPrecision(2)), THINNEST), WIDEST) }), (power) => (10 ** power).toExponential(1).replace(".0e", "e"));
  hair.id = "thinness";
  shows.push(() => (hair.disabled = state.hair === null));

  return { show: (now) => ((state = now), shows.forEach((each) => each())) };
}
