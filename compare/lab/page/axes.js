// An axis of pixels: the value at one, and the place of a value among them.

// As numpy.linspace, to the last bit: the pixel's toss is the map's.
export const valueAt = ({ start, stop, count }, index) => (index === count - 1 ? stop : start + index * ((stop - start) / (count - 1)));

export const indexOf = ({ start, stop, count }, value) => ((value - start) / (stop - start)) * (count - 1);
