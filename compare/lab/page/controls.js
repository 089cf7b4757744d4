// The controls of the lab: coin, floor, air, release, hand and map, from lists of what each changes.

import { COINS, coinPicture } from "./coins.js";
import { changed } from "./engine.js";

const TURN = 180 / Math.PI;
const TOUCHES = 12; // that are offered

// Sliders in the units that are shown: field, label, unit, units in one SI unit, least and most.
const SLIDERS = {
  coin: [
    ["coin.radius", "radius", "mm", 1e3, 5, 20], ["coin.thickness", "thickness", "mm", 1e3, 0, 20], ["coin.mass", "mass", "g", 1e3, 0.5, 50],
    ["coin.center_of_mass.xi", "mass centre aside", "mm", 1e3, -3, 3], ["coin.center_of_mass.zeta", "mass centre up", "mm", 1e3, -0.9, 0.9],
  ],
  floor: [["floor.restitution", "restitution χ", "", 1, 0, 1], ["floor.friction", "friction μ", "", 1, 0, 1]],
  release: [
    ["release.position.z", "height", "m", 1, 0.03, 1.5], ["release.velocity.z", "speed upwards", "m/s", 1, 0, 4],
    ["release.angular_velocity.eta", "spin", "rad/s", 1, 0, 150], ["release.angular_velocity.zeta", "wobble: spin about the normal", "rad/s", 1, 0, 100],
    ["release.angles.theta", "tilt", "°", TURN, 0, 90],
  ],
};
const AXES = [...Object.values(SLIDERS).flat().map(([field, label, , factor, low, high]) => [field, label, low / factor, high / factor]),
  ["release.velocity.x", "speed aside", 0, 2], ["release.angular_velocity.xi", "spin about ξ", 0, 150]];
const LAWS = { smooth: "smooth", coulomb: "Coulomb", perfectly_rough: "perfectly rough", knurled: "knurled", sharp_edge: "sharp edge",
  slip_preserving: "slip-preserving", sliding_friction: "sliding friction" };
const AIR = { "air.normal": 0.8, "air.tangential": 0.2 };

// Fills the boxes of the page with controls. `change` is called with what is to be other in the state.
export function makeControls(boxes, fields, change) {
  const shows = [];
  let state = null;
  const scenario = (more) => change({ scenario: changed(state.scenario, more) });
  const value = (field) => state.scenario[field] ?? fields[field]?.default ?? 0;

  function slider(box, name, unit, low, high, read, write) {
    const label = element("label", "slider"), input = element("input"), output = element("output");
    Object.assign(input, { type: "range", min: low, max: high, step: "any" });
    label.append(element("span", "", name), input, output);
    input.addEventListener("input", () => write(Number(input.value)));
    shows.push(() => {
      const now = read();
      input.value = String(now);
      output.textContent = `${Number(now.toPrecision(4))}${unit && (unit === "°" ? unit : `\u00a0${unit}`)}`;
      input.setAttribute("aria-valuetext", output.textContent);
    });
    box.append(label);
    return input;
  }

  function fieldSlider(box, [field, name, unit, factor, low, high]) {
    const input = slider(box, name, unit, low, high, () => value(field) * factor, (shown) => {
      const caught = field === "release.position.z" && "ending.caught" in state.scenario;
      scenario({ [field]: shown / factor, ...(caught && { "ending.caught": shown / factor }) });
    });
    input.dataset.field = field;
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
    const label = element("label", "tick"), input = element("input");
    input.type = "checkbox";
    label.append(input, element("span", "", name));
    input.addEventListener("change", () => write(input.checked));
    shows.push(() => (input.checked = read()));
    box.append(label);
    return input;
  }

  function without(...names) {
    change({ scenario: Object.fromEntries(Object.entries(state.scenario).filter(([field]) => !names.includes(field))) });
  }

  const presets = element("div", "presets");
  presets.setAttribute("role", "group");
  presets.setAttribute("aria-label", "Coins");
  for (const [name, coin] of Object.entries(COINS)) {
    const button = element("button");
    button.type = "button";
    button.append(coinPicture(coin), element("span", "", name));
    button.addEventListener("click", () => preset(coin));
    shows.push(() => button.setAttribute("aria-pressed", String(Object.entries(coin).every(([key, each]) => value(`coin.${key}`) === each))));
    presets.append(button);
  }
  boxes.coin.append(presets);

  // A coin as it is told: with the cylinder's inertia, and its mass centre in the middle.
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
    choice(boxes.map, label, Object.fromEntries(AXES.map(([field, text]) => [field, text])), () => state[name].field, (field) => {
      const [, , from, to] = AXES.find(([each]) => each === field);
      const swapped = state[other].field === field && { [other]: state[name] };
      change({ [name]: swapped ? state[other] : { field, from, to }, ...swapped, before: null });
    }).id = `across-${name}`;
  }
  tick(boxes.map, "hatch what the engine's own errors may decide", () => state.trust, (trust) => change({ trust })).id = "trust";
  tick(boxes.hand, "a hand's scatter", () => state.hand !== null, (on) => change({ hand: on ? 0.02 : null })).id = "hand";
  const scatter = slider(boxes.hand, "of height, speed and spin", "%", 0.1, 20, () => 100 * (state.hand ?? 0.02), (percent) => change({ hand: percent / 100 }));
  shows.push(() => (scatter.disabled = state.hand === null));

  return {
    show(now) {
      state = now;
      for (const each of shows) each();
    },
  };
}

export function element(tag, kind = "", text = "") {
  const made = document.createElement(tag);
  if (kind) made.className = kind;
  if (text) made.textContent = text;
  return made;
}
