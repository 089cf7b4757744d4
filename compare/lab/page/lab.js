// The lab's page: joins coin, map, controls, tour and address, which all show one state.

import { changed, spun, unpacked } from "./engine.js";
import { startWorkers } from "./workers.js";
import { legendOf } from "./elements.js";
import { LABELS as ENGINES, showEnergy } from "./motion.js";
import { counted, outcomeLine, outcomeText } from "./outcome.js";
import { makeSaved } from "./saved.js";
import { LABELS, shownAs } from "./words.js";
import { makeControls } from "./controls.js";
import { makeLiveMap } from "./live_map.js";
import { makeStage } from "./stage.js";
import { horizonText, markTouch, showSequences } from "./sequences.js";
import { address, fromAddress, START } from "./state.js";
import { savedThere, tossedByMujoco, tossedThere } from "./served.js";
import { makeTour, STOPS } from "./tour.js";
import { countHeads } from "./hand.js";
import { makeHundred } from "./hundred_shown.js";
import { makeThrows } from "./throws.js";
import { glide } from "./glide.js";
import { copied, saveCsv, savePng, saveToml } from "./save.js";
import { command } from "./toml.js";

const PLOT = 150; // pixels: the height of the energies
const SAMPLES = 800; // of the path that is played
const FOLLOWED = 3; // seconds for which a coin is shown, whatever was proved before
const REST = 120; // milliseconds for which a slider has rested when its coin is tossed: before, the map alone follows
const PAUSE = 250; // milliseconds until the address follows, which browsers allow some times a second
const ENDS = "Double precision ends here: neighbouring tosses differ in the last bit of a number, and no toss lies between them.";
const NAMES = { analytic: "this toss", before: "the toss before" };
const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("data").textContent), { outcomes } = data;

let engine, workers, fields, saved = null, state, stage, map, controls, hundred, throws, showStop, moveEnergy = () => {}, stopGlide = () => {}, ahead = null;
let tosses = [null, null], tossed = null, wanted = null, isTossing = false, counting = null, pending = null, resting = null;

async function begin() {
  workers = await startWorkers(await unpacked(data.wasm));
  engine = workers.engine;
  if (data.served) [workers.tossMap, byId("where").textContent] = [tossedThere, "on this machine"];
  fields = Object.fromEntries(engine.about.fields.map((field) => [field.name, { ...field, word: LABELS[field.name] ?? field.word }]));
  fields["release.spin"] = { word: "spin", unit: "rad/s" };
  if (data.saved) open(data.saved === true ? await savedThere() : data.saved);
  hundred = makeHundred({ box: byId("crowd"), scene: byId("hundred"), strip: byId("strip"), up: byId("up"), heads: byId("heads"), parting: byId("parting") }, workers, say);
  stage = makeStage(byId("played"), {
    without: "The map, the sequences and the energies work without it.", labels: saved ? ENGINES : NAMES, shown: "The coin that is tossed",
    isBusy: () => byId("map").ariaBusy === "true",
    onTime(time) {
      markTouch(byId("sequences"), [tosses[0], tosses[2]], time);
      hundred.draw(time);
      moveEnergy(time);
      if (throws.isInTheAir() && time >= tosses[0].end_time) land();
    },
  });
  map = makeLiveMap({
    canvas: byId("map"), workers, fields, outcomes, saved, marks: () => [...(saved?.shows(state) ? saved.dots : []), ...(throws?.marks() ?? [])],
    told: {
      place: (place) => (byId("readout").textContent = placeText(place)),
      choose,
      moved: change,
      end: (isEnd) => (byId("ends").textContent = isEnd ? ENDS : ""),
      nearest: (text) => (byId("boundary").textContent = text),
      problem: say,
      progress(part, isCoarse) {
        byId("map").setAttribute("aria-busy", String(part < 1));
        byId("map").dataset.seen = String(isCoarse);
        if (isCoarse) legend();
      },
    },
  });
  const box = (name) => byId(`of-${name}`);
  controls = makeControls({ map: box("map"), release: box("release"), coin: box("coin"), floor: box("floor"), hand: box("hand"), hair: box("hair") }, fields, change);
  showStop = makeTour({ list: byId("tour"), box: byId("stop"), back: byId("back"), next: byId("next") }, (stop) => address(stop, fields), visit);
  throws = makeThrows({ handle: byId("flick"), box: byId("challenge"), told: byId("thrown"), curve: byId("curve"), again: byId("again") },
    { change: (more) => change(more, true), isCaught: () => "ending.caught" in state.scenario, state: settled });
  listen();
  restore();
  document.body.dataset.ready = "true";
}

// Opens a map that was made: both engines toss its pixels.
function open(found) {
  saved = makeSaved(found, data.tosses, data.scenario, fields, outcomes);
  document.body.classList.add("saved");
  document.title = `${saved.title}: the coin lab`;
  byId("name").textContent = saved.title;
  byId("about").textContent = saved.about;
  if (!data.served && saved.engine === "mujoco") workers.tossMap = () => Promise.reject(new Error("MuJoCo tosses no map in this file; cointoss explore does"));
}

function listen() {
  const copy = async (text) => (byId("copied").textContent = await copied(text, byId("command")));
  const clicks = {
    "zoom-in": () => map.zoom(0.5), "zoom-out": () => map.zoom(2), whole: () => map.showWhole(), print: () => print(),
    both() {
      byId("both").setAttribute("aria-pressed", String(!areBoth()));
      showTosses(true);
    },
    copy: () => copy(command({ ...state, scenario: spun(state.scenario) }, fields, map.grid())),
    link: () => copy(new URL(address(state, fields), location.href).href),
    toml: () => saveToml(spun(state.scenario), fields), png: () => savePng(byId("map")), csv: () => saveCsv(map.seen(), state.trust, outcomes),
  };
  for (const [id, act] of Object.entries(clicks)) byId(id).addEventListener("click", act);
  addEventListener("hashchange", restore);
}

// The state of the address, or of the page where that names none.
function restore() {
  const start = { ...START, scenario: data.scenario, ...saved?.state };
  let found = data.tour ? STOPS[0].state : start;
  say("");
  stopGlide();
  ahead = null;
  if (location.hash.length > 1) {
    try {
      found = fromAddress(location.hash, fields, (scenario) => engine.fault(scenario), start);
    } catch (problem) {
      say(`The address is no state of the lab: ${problem.message}. Shown is what the page begins with.`);
    }
  }
  take(found, true);
  const { x, y, scenario } = state;
  if (saved?.shows(state)) byId("readout").textContent = placeText(saved.place(scenario[x.field], scenario[y.field]));
}

// Goes to a stop of the tour: the controls move there, where they can be followed.
function visit(stop) {
  stopGlide();
  say("");
  ahead = stop;
  stopGlide = glide(state, stop, fields, (now, isThere) => {
    if (isThere) ahead = null;
    take(now, isThere, !isThere);
  });
}

// The state, at the stop where it was on the way to one.
function settled() {
  stopGlide();
  if (ahead) take(ahead, false);
  ahead = null;
  return state;
}

function take(found, fresh, isOnTheWay = false) {
  state = { ...found, home: homeOf(found) };
  show(fresh, isOnTheWay);
}

// The whole map over the fields of a state.
const homeOf = ({ x, y }) => (saved?.state.x.field === x.field && saved.state.y.field === y.field ? { x: saved.state.x, y: saved.state.y } : { x, y });

// Changes the state; where that gives no scenario, says why and changes nothing.
function change(more, fresh = false) {
  stopGlide();
  ahead = null;
  const wrong = more.scenario ? engine.fault(more.scenario) : null, isOtherMap = ["x", "y"].some((name) => more[name] && more[name].field !== state[name].field);
  if (more.scenario || isOtherMap) say(wrong ?? "");
  if (wrong === null) state = { ...state, ...more };
  if (isOtherMap) state.home = homeOf(state);
  if (wrong === null) show(fresh);
  else controls.show(state);
}

function show(fresh, isOnTheWay = false) {
  controls.show(state);
  map.update(state);
  showStop(state, isOnTheWay);
  throws.show();
  clearTimeout(resting);
  if (fresh) tossAndCount(true);
  else resting = setTimeout(tossAndCount, REST);
  if (isOnTheWay) return;
  clearTimeout(pending);
  // A page in the frame of a notebook has no address of its own.
  if (location.protocol !== "about:") pending = setTimeout(() => history.replaceState(null, "", address(state, fields)), PAUSE);
}

const tossAndCount = (fresh = false) => (toss(fresh), count());

function choose(place) {
  const { x, y } = place, { scenario } = state, before = [scenario[state.x.field] ?? 0, scenario[state.y.field] ?? 0];
  byId("readout").textContent = placeText(place);
  if (before[0] === x && before[1] === y) return toss(true);
  change({ before, scenario: changed(scenario, { [state.x.field]: x, [state.y.field]: y }) }, true);
}

// Tosses what was chosen last; what came between is passed over. Nothing is tossed twice in a row.
async function toss(fresh) {
  const at = ([x, y]) => changed(state.scenario, { [state.x.field]: x, [state.y.field]: y });
  const scenarios = [state.scenario, state.before && at(state.before)];
  const key = JSON.stringify([scenarios, state.after, state.hair]);
  if (key === tossed && !fresh && !wanted) return;
  wanted = { scenarios, key, state, fresh: fresh || (wanted?.fresh ?? false) };
  if (isTossing) return;
  isTossing = true;
  while (wanted) {
    const { scenarios, key, state: asked, fresh } = wanted;
    wanted = null;
    try {
      if (key !== tossed) {
        const [one, before] = await Promise.all(scenarios.map((each) => each && workers.toss(followed(each), SAMPLES)));
        await hundred.toss(spun(asked.scenario), asked.hair);
        tosses = [saved ? one : { ...one, label: NAMES.analytic }, before && { ...before, engine: "before", label: "before" }];
        tossed = key;
      }
      showTosses(fresh);
      if (!saved || tosses[2] || wanted) continue;
      tosses[2] = data.served ? await tossedByMujoco(engine.row(asked.scenario)) : saved.tossOf(asked);
      if (!wanted) showTosses(false);
    } catch (problem) {
      say(problem.message);
    }
  }
  isTossing = false;
}

// What a hand has caught it holds.
const followed = (scenario) => ("ending.caught" in scenario || "ending.until" in scenario ? scenario : { ...scenario, "ending.until": FOLLOWED });

const areBoth = () => byId("both").getAttribute("aria-pressed") === "true";

function showTosses(fresh) {
  const [one, before, other = null] = tosses, own = saved ? [one, other] : [one], shown = areBoth() && before ? [one, before] : own;
  byId("both").disabled = !before;
  showSequences(byId("sequences"), own, before, state.after);
  byId("horizon").textContent = one.count ? horizonText([one, other], before, state.after) : "";
  byId("sequences").hidden = one.count === 0;
  moveEnergy = showEnergy(byId("energy"), shown, PLOT);
  if (saved) byId("outcome").replaceChildren(outcomeLine(one), outcomeLine(other ?? { engine: "mujoco" }));
  else byId("outcome").textContent = throws.isInTheAir() ? "The coin is in the air." : outcomeText(one);
  document.querySelector(".coin").classList.toggle("crowded", hundred.isShown());
  const played = hundred.longest() ?? null, isFinal = saved && state.after !== null;
  const told = (toss) => (throws.isInTheAir() ? "" : !toss ? "…" : toss.problem ? "no toss" : `${isFinal ? "final: " : ""}${toss.outcome}`);
  stage.show(played ? [played] : shown, (played ? [played] : shown).map(told), fresh,
    throws.isInTheAir() || played ? undefined : one.times[state.after]); // the touch that the map shows
  byId("energy").hidden = hundred.isShown();
}

// What was thrown has come down: nobody knew its face before.
function land() {
  const [{ outcome }] = tosses;
  byId("outcome").textContent = outcomeText(tosses[0]);
  byId("state-analytic").textContent = outcome;
  throws.landed(outcome);
}

// The share of heads of the hand, from its own tosses.
async function count() {
  const key = JSON.stringify([state.scenario, state.after, state.hand]);
  if (counting?.key === key) return;
  counting?.controller.abort();
  const controller = new AbortController(), percent = (part) => (100 * part).toFixed(1);
  counting = { key, controller };
  byId("share").hidden = byId("bar").hidden = state.hand === null;
  byId("share").dataset.whole = "false";
  if (state.hand === null) return;
  byId("share").textContent = "The hand tosses …";
  try {
    await countHeads(workers, { ...state, scenario: spun(state.scenario) }, ({ share, low, high, count, isWhole }) => {
      const when = state.after === null ? "" : ` at touch ${state.after + 1}`;
      byId("share").textContent = `Of ${counted(count, "toss", "tosses")} by this hand ${percent(share)} % show heads${when} ` +
        `[${percent(low)}, ${percent(high)}; 99 % interval]. Dashed: one standard deviation.`;
      byId("bar").firstElementChild.style.width = `${percent(share)}%`;
      byId("share").dataset.whole = String(isWhole);
    }, controller.signal);
  } catch (problem) {
    say(problem.message);
  }
}

function valuesText(x, y) {
  const part = (field, value) => `${fields[field].word} = ${shownAs(value)} ${fields[field].unit}`.trim().replaceAll(" ", "\u00a0");
  return `${part(state.x.field, x)}, ${part(state.y.field, y)}`;
}

// What is hatched: of a final outcome that it is not certain, of a touch that it is not trusted.
const doubtText = () => (state.after === null ? "not certain" : "not trusted");

function placeText({ x, y, code, trusted, known }) {
  const parts = [valuesText(x, y)];
  if (code !== -1) parts.push(code === -2 ? "no scenario" : outcomes[code].label);
  if (trusted === 0) parts.push(doubtText());
  if (known) parts.push(known);
  return parts.join("; ");
}

// What is on the map.
function legend() {
  const codes = new Set(map.seen().codes), entries = Object.entries(outcomes).filter(([code]) => codes.has(Number(code))).map(([, { label, color }]) => [label, color]);
  if (saved?.shows(state) && !saved.isWhole) entries.push(["not tossed", "var(--untossed)"]);
  if (state.trust) entries.push([`${doubtText()}: rounding errors may have decided the face`, "repeating-linear-gradient(135deg, #fff 0 2px, var(--soft) 2px 6px)"]);
  if (byId("legend").dataset.shows === String(entries)) return;
  byId("legend").dataset.shows = String(entries);
  byId("legend").replaceChildren(...legendOf(entries));
}

const say = (message) => Object.assign(byId("problem"), { textContent: message, hidden: !message });

begin().catch((problem) => {
  say(`The lab cannot toss: ${problem.message}.`);
  document.body.dataset.ready = "true";
});
