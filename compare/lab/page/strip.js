// The faces of a hundred coins, a row for each coin and a column for each touch.

import { faceAt, headsByTouch } from "./hundred.js";

const MOST = 24; // touches that are shown
const FACES = { H: "#f5ab1f", T: "#0d5ca8" };

export function drawStrip(canvas, tosses) {
  const touches = Math.min(headsByTouch(tosses).length, MOST), pen = canvas.getContext("2d");
  canvas.width = Math.max(touches, 1);
  canvas.height = tosses.length;
  tosses.forEach((toss, i) => {
    for (let touch = 1; touch <= touches; touch++) {
      pen.fillStyle = FACES[faceAt(toss, touch)] ?? "#888";
      pen.fillRect(touch - 1, i, 1, 1);
    }
  });
  canvas.setAttribute("aria-label", `Heads among ${tosses.length} coins at each touch: ${headsByTouch(tosses).slice(0, touches).join(", ")}`);
}
