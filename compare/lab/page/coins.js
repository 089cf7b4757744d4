// Coins to begin with, each with its picture to scale.

import { shape } from "./elements.js";

// The former Polish 1 zloty (Strzalko et al. 2008, section 5.1), the US nickel, the euro, a thin coin, and the coin
// of the nickel's width and metal that falls on its edge about as often as on either face where it turns about a
// diameter and the floor's restitution is 0.8.
export const COINS = {
  zloty: { radius: 0.0125, thickness: 0.002, mass: 0.002 },
  nickel: { radius: 0.010605, thickness: 0.00195, mass: 0.005 },
  euro: { radius: 0.011625, thickness: 0.00233, mass: 0.0075 },
  thin: { radius: 0.0125, thickness: 0, mass: 0.002 },
  "three-way": { radius: 0.010605, thickness: 0.0177, mass: 0.0454 },
};

const SCALE = 1500, FLAT = 0.35;

// The coin as it lies, seen from above at a slant.
export function coinPicture({ radius, thickness }) {
  const svg = shape("svg", { viewBox: "-20 -16 40 32", "aria-hidden": true }), wide = radius * SCALE, tall = thickness * SCALE * 0.94, foot = FLAT * wide;
  const top = -tall / 2, low = tall / 2;
  const side = `M${-wide} ${top}V${low}A${wide} ${foot} 0 0 0 ${wide} ${low}V${top}Z`;
  svg.append(shape("path", { d: side, fill: "#8b929c" }), shape("ellipse", { cx: 0, cy: top, rx: wide, ry: foot, fill: "#f5ab1f", stroke: "#7a5200" }));
  return svg;
}
