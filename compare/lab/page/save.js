// What leaves the page: the command, and files of what is seen.

import { valueAt } from "./axes.js";
import { toml } from "./toml.js";

export const saveToml = (scenario, fields) => save("coin.toml", new Blob([toml(scenario, fields)], { type: "text/plain" }));
export const savePng = (canvas) => canvas.toBlob((picture) => save("coin.png", picture), "image/png");
export const saveCsv = (job, trust, outcomes) => save("coin.csv", new Blob([csv(job, trust, outcomes)], { type: "text/csv" }));

// A row for each pixel that was tossed: both values and the outcome, and with trust whether it can be trusted.
export function csv({ x, y, codes, trusted, isTossed }, trust, outcomes) {
  const rows = [[x.field, y.field, "outcome", ...(trust ? ["trusted"] : [])].join(",")];
  for (let j = 0; j < y.count; j++) {
    for (let i = 0; i < x.count; i++) {
      const at = j * x.count + i, outcome = isTossed[at] ? (outcomes[codes[at]]?.label ?? "no scenario") : "not tossed";
      rows.push([valueAt(x, i), valueAt(y, j), outcome, ...(trust ? [trusted[at]] : [])].join(","));
    }
  }
  return `${rows.join("\n")}\n`;
}

// Copies a text; where the browser refuses, it is shown to be copied.
export async function copied(text, box) {
  box.textContent = text;
  box.hidden = false;
  try {
    await navigator.clipboard.writeText(text);
    return "Copied.";
  } catch {
    getSelection().selectAllChildren(box);
    return "The browser refuses the clipboard; the text is selected below.";
  }
}

function save(name, blob) {
  const link = Object.assign(document.createElement("a"), { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
}
