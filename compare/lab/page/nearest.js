// Where the nearest other colour of a map of one colour lies.

// How many columns to the right and rows up from a pixel the nearest one has another code, null for none; `codes` are
// row by row, and those below 0 are no outcomes.
export function nearestOther(codes, columns, [column, row], code) {
  let found = null, least = Infinity;
  codes.forEach((each, at) => {
    const way = [(at % columns) - column, Math.floor(at / columns) - row], far = Math.hypot(...way);
    if (each >= 0 && each !== code && far < least) [found, least] = [way, far];
  });
  return found;
}

// What is told of it: a `label` for what is seen, the way there, and both axes as in axes.js.
export function nearestText(label, way, axes) {
  if (!way) return `All that is seen is ${label}, and no other colour was found around it.`;
  const [across, up] = [["left", "right"], ["lower", "upper"]].map((names, i) => way[i] && names[Number(way[i] > 0)]);
  const where = across ? `to the ${[up, across].filter(Boolean).join(" ")} of` : up === "upper" ? "above" : "below";
  const parts = axes.map(({ word, unit }, i) => way[i] && `${way[i] > 0 ? "+" : "−"}${[Number(Math.abs(way[i]).toPrecision(2)), unit].join(" ").trim()} in ${word}`);
  return `All that is seen is ${label}. The nearest other colour lies ${where} the middle: roughly ${parts.filter(Boolean).join(" and ")}.`;
}
