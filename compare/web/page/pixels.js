// Pixels as pictures, the first row below: outcomes in their colours, and masks.

export const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// The colours of outcomes by their codes, of -1 for what is not tossed; `outcomes` has { color } by code.
export function colorsOf(outcomes) {
  const named = { "-1": style("--untossed"), ...Object.fromEntries(Object.entries(outcomes).map(([code, { color }]) => [code, color])) };
  return Object.fromEntries(Object.entries(named).map(([code, color]) => [code, [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16))]));
}

export function picture(codes, width, height, colors) {
  return painted(codes, width, height, (code) => [...(colors[code] ?? colors["-1"]), 255]);
}

// White where a value is 1, else transparent.
export function mask(values, width, height) {
  return painted(values, width, height, (value) => [255 * value, 255 * value, 255 * value, 255 * value]);
}

function painted(values, width, height, color) {
  const image = document.createElement("canvas");
  image.width = width;
  image.height = height;
  const pen = image.getContext("2d"), pixels = pen.createImageData(width, height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) pixels.data.set(color(values[row * width + column]), 4 * ((height - 1 - row) * width + column));
  }
  pen.putImageData(pixels, 0, 0);
  return image;
}
