// Both coins side by side in 3D, with their clock and what one can choose.

import { LABELS } from "./motion.js";
import { makePlayer } from "./player.js";
import { makeScene } from "./scene.js";

const MARKUP = `
<div class="stage" id="stage">
  <canvas id="coins" role="img" aria-label="The coin as tossed by each engine"></canvas>
  <div class="panel analytic"><b></b> <span id="state-analytic"></span></div>
  <div class="panel mujoco"><b></b> <span id="state-mujoco"></span></div>
  <p id="hint"></p>
</div>
<div class="controls">
  <button id="play" type="button" disabled>Play</button>
  <input id="time" type="range" min="0" max="1" step="any" value="0" aria-label="Time" disabled>
  <output id="clock">0.000 s</output>
  <label>speed <select id="speed">
    <option value="1">real</option><option value="0.5">1/2</option><option value="0.25">1/4</option>
    <option value="0.125" selected>1/8</option><option value="0.03125">1/32</option>
  </select></label>
  <label>view <select id="camera">
    <option value="follow" selected>close</option><option value="whole">whole path</option>
  </select></label>
</div>`;

// Fills a box with the stage. `hint` stands in it until there are tosses; `without` says what works without WebGL.
export function makeStage(box, { hint = "", without, onTime }) {
  box.innerHTML = MARKUP;
  const byId = (id) => document.getElementById(id);
  for (const [engine, label] of Object.entries(LABELS)) box.querySelector(`.${engine} b`).textContent = label;
  byId("hint").textContent = hint;
  let scene = null;
  try {
    scene = makeScene(byId("coins"));
  } catch {
    byId("hint").textContent = `The coins are not shown: this browser has no WebGL. ${without}`;
    byId("coins").hidden = byId("camera").disabled = true;
    byId("stage").classList.add("empty");
  }
  const player = makePlayer((time) => {
    scene?.draw(time);
    onTime(time);
  });
  byId("camera").addEventListener("change", (event) => {
    scene?.look(event.target.value);
    player.redraw();
  });
  byId("coins").addEventListener("pointermove", () => player.redraw());
  new ResizeObserver(() => player.redraw()).observe(byId("stage"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => requestAnimationFrame(() => player.redraw()));

  // No hint stands over the coins, but that there are none.
  const clear = () => (byId("hint").hidden = scene !== null);
  return {
    clear,
    seek: player.seek,
    // Tosses, null for one that is missing, and what each panel says; `fresh` plays them from the start.
    show(tosses, states, fresh) {
      clear();
      scene?.show(tosses);
      Object.keys(LABELS).forEach((engine, i) => {
        byId(`state-${engine}`).textContent = states[i] ?? "";
        box.querySelector(`.panel.${engine}`).hidden = i >= tosses.length;
      });
      player.load(Math.max(0, ...tosses.filter((one) => one?.path).map((one) => one.end_time)), fresh);
    },
  };
}
