// Elements of a page, and of a drawing in it.

const SVG = "http://www.w3.org/2000/svg";

export const element = (tag, kind = "", text = "") =>
  Object.assign(document.createElement(tag), { ...(kind && { className: kind }), textContent: text });

export function shape(tag, attributes = {}, text = "") {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

// Items of a legend, of entries [label, color].
export const legendOf = (entries) => entries.map(([label, color]) => {
  const item = element("li"), patch = element("i");
  patch.style.background = color;
  item.append(patch, label);
  return item;
});
