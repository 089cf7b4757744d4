// One coin, or several side by side, in 3D, with their clock and what one can choose.

import { element } from "./elements.js";
import { LABELS } from "./motion.js";
import { makePlayer } from "./player.js";
import { makeScene } from "./scene.js";
import { makeSound } from "./sound.js";

const SLOW = { gap: 34, rest: 200 }; // [ms] between two pictures: slow from here on, and then while the page is busy

const MARKUP = `
<div class="stage" id="stage">
  <canvas id="coins" role="img"></canvas>
  <p id="hint"></p>
</div>
<div class="controls">
  <button id="play" type="button" disabled>Play</button>
  <span class="timeline"><input id="time" type="range" min="0" max="1" step="any" value="0" aria-label="Time" disabled><span id="marks" hidden></span></span>
  <output id="clock">0.000 s</output>
  <label>speed <select id="speed">
    <option value="1">real</option><option value="0.5">1/2</option><option value="0.25">1/4</option>
    <option value="0.125" selected>1/8</option><option value="0.03125">1/32</option>
  </select></label>
  <label>view <select id="camera">
    <option value="close" selected>close</option><option value="whole">whole path</option>
  </select></label>
  <button id="sound" type="button" aria-pressed="false">Sound</button>
</div>`;

// Fills a box with the stage; `without` says what works without WebGL.
// `labels` names the coins by the engine of their tosses, and `shown` says what the picture shows. While `isBusy` says that
// the page computes something else, a browser that draws slowly, without a graphics card, draws few pictures.
export function makeStage(box, { without, labels = LABELS, shown = "The coin as tossed by each engine", isBusy = () => false, onTime }) {
  box.innerHTML = MARKUP;
  const byId = (id) => document.getElementById(id);
  byId("coins").setAttribute("aria-label", shown);
  const states = Object.entries(labels).map(([engine, label], _, all) => {
    const panel = element("div", `panel ${engine}`), state = Object.assign(element("span"), { id: `state-${engine}` });
    panel.style.setProperty("--part", String(1 / all.length));
    panel.append(element("b", "", label), " ", state);
    byId("hint").before(panel);
    return state;
  });
  let scene = null;
  try {
    scene = makeScene(byId("coins"));
  } catch {
    byId("hint").textContent = `The coins are not shown: this browser has no WebGL. ${without}`;
    byId("coins").hidden = byId("camera").disabled = true;
    byId("stage").classList.add("empty");
  }
  const sound = makeSound(byId("sound"));
  let drawn = 0, last = 0, gap = 0; // of a picture to the next frame
  const player = makePlayer((time, before) => {
    const now = performance.now();
    if (before !== null && drawn === last) gap = 0.8 * gap + 0.2 * Math.min(now - last, SLOW.rest);
    last = now;
    if (before !== null && gap > SLOW.gap && isBusy() && now - drawn < SLOW.rest) return;
    drawn = now;
    scene?.draw(time);
    if (before !== null) sound.play(before, time);
    onTime(time);
  });
  byId("camera").addEventListener("change", (event) => {
    scene?.look(event.target.value);
    player.redraw();
  });
  byId("coins").addEventListener("pointermove", () => player.redraw());
  new ResizeObserver(() => player.redraw()).observe(byId("stage"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => requestAnimationFrame(() => player.redraw()));

  return {
    seek: player.seek,
    // Tosses, null for one that is missing, and what each panel says; `fresh` plays them from the start, or shows
    // the moment `still`, by default the end, where motion is unwanted.
    show(tosses, told, fresh, still) {
      byId("hint").hidden = scene !== null; // no hint stands over the coins, but that there are none
      scene?.show(tosses);
      states.forEach((state, i) => {
        state.textContent = told[i] ?? "";
        state.parentElement.hidden = i >= tosses.length;
      });
      sound.load(tosses);
      player.load(tosses, fresh, still);
    },
  };
}
