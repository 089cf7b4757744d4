// Numbers and counts in words.

export const counted = (number, thing, things = `${thing}s`) => `${number.toLocaleString("en")} ${number === 1 ? thing : things}`;

// A value in full where few digits tell it, else with ten.
export const shownAs = (value) => String(Number(value.toPrecision(10)));
