// One or two tosses that are played: the coins, their sequences, how they ended, and their energy.

import { nameOf, showEnergy } from "./motion.js";
import { outcomeLine } from "./outcome.js";
import { horizonText, markTouch, showSequences } from "./sequences.js";
import { makeStage } from "./stage.js";

const tosses = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

byId("outcome").replaceChildren(...tosses.map(outcomeLine));
showSequences(byId("sequences"), tosses, null, null);
byId("horizon").textContent = horizonText(tosses, null, null);
const moveEnergy = showEnergy(byId("energy"), tosses);
const stage = makeStage(byId("played"), {
  without: "The sequences and the energies work without it.", shown: "The coins that are tossed",
  labels: Object.fromEntries(tosses.map((toss) => [toss.engine, nameOf(toss)])),
  onTime(time) {
    markTouch(byId("sequences"), tosses, time);
    moveEnergy(time);
  },
});
stage.show(tosses, tosses.map((toss) => toss.outcome), true);
document.body.dataset.ready = "true";
