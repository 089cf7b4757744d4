// A click at each touch of the coins that are played, as loud as the coin is fast; off until a button is pressed.

import { valueAt } from "./sampled.js";
import { touchesOf } from "./timeline.js";

const NEAR = 1e-3; // seconds before and after a touch, over which its change of speed is measured
const QUIETEST = 0.02; // a touch that is softer than this part of the hardest is not heard
const TONES = [[3100, 1], [5170, 0.6], [7890, 0.35]]; // hertz, and how loud
const LASTS = 0.09; // seconds

export function makeSound(button) {
  let context = null, touches = [];
  const isOn = () => button.getAttribute("aria-pressed") === "true";

  button.addEventListener("click", () => {
    button.setAttribute("aria-pressed", String(!isOn()));
    if (!isOn()) return;
    context ??= new AudioContext();
    context.resume();
  });

  function click(loudness) {
    const now = context.currentTime, gain = context.createGain();
    gain.gain.setValueAtTime(0.3 * loudness, now);
    gain.gain.exponentialRampToValueAtTime(1e-4, now + LASTS);
    gain.connect(context.destination);
    for (const [frequency, part] of TONES) {
      const tone = context.createOscillator(), share = context.createGain();
      tone.frequency.value = frequency;
      share.gain.value = part;
      tone.connect(share).connect(gain);
      tone.start(now);
      tone.stop(now + LASTS);
    }
  }

  return {
    load: (tosses) => (touches = tosses.filter((toss) => toss?.path).flatMap(loudnesses)),
    // The hardest touch between two times that are played is heard.
    play(from, to) {
      if (!isOn()) return;
      const loudest = Math.max(0, ...touches.filter(({ time }) => time > from && time <= to).map(({ loudness }) => loudness));
      if (loudest >= QUIETEST) click(loudest);
    },
  };
}

// The touches of a toss, each as loud as it changes the vertical speed, from 0 to 1.
function loudnesses(toss) {
  const { time, position } = toss.path, height = time.map((_, k) => position[3 * k + 2]);
  const at = (moment) => valueAt(time, height, Math.min(Math.max(moment, time[0]), time.at(-1)));
  const found = touchesOf(toss).map((each) => ({ time: each, loudness: Math.max(at(each + NEAR) + at(each - NEAR) - 2 * at(each), 0) }));
  const most = Math.max(0, ...found.map(({ loudness }) => loudness)) || 1;
  return found.map((each) => ({ ...each, loudness: each.loudness / most }));
}
