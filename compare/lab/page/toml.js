// A scenario as a TOML file, and the command that makes the map that is seen.

const BODY = ["xi", "eta", "zeta"];
const COMPONENTS = {
  "coin.center_of_mass": BODY,
  "release.position": ["x", "y", "z"],
  "release.velocity": ["x", "y", "z"],
  "release.angles": ["psi", "theta", "phi"],
  "release.quaternion": ["e0", "e1", "e2", "e3"],
  "release.angular_velocity": BODY,
};
const TABLES = ["coin", "air", "floor", "release", "ending"];

export function toml(scenario, fields) {
  const lines = Object.fromEntries(["", ...TABLES].map((table) => [table, []])), done = new Set();
  const inertia = BODY.map((row) => BODY.map((each) => scenario[`coin.inertia.${row}.${each}`]));
  for (const field of Object.keys(scenario)) {
    const path = field.slice(0, field.lastIndexOf("."));
    const vector = COMPONENTS[path], name = vector ? path : field;
    if (done.has(name) || name.startsWith("coin.inertia.")) continue;
    done.add(name);
    const value = vector
      ? `[${vector.map((each) => text(scenario[`${path}.${each}`] ?? fields[`${path}.${each}`]?.default ?? 0)).join(", ")}]`
      : text(scenario[field]);
    const [table, key] = name.includes(".") ? name.split(".") : ["", name];
    lines[table].push(`${key} = ${value}`);
  }
  if (inertia[0][0] !== undefined) lines.coin.push(`inertia = [${inertia.map((row) => `[${row.map(text).join(", ")}]`).join(", ")}]`);
  const blocks = Object.entries(lines).filter(([table, rows]) => rows.length || ["coin", "floor", "release"].includes(table));
  return blocks.map(([table, rows]) => [...(table ? [`[${table}]`] : []), ...rows].join("\n")).join("\n\n") + "\n";
}

export function command({ scenario, after, trust }, fields, { x, y }) {
  const axis = ({ field, start, stop, count }) => `${field}=${start}:${stop}:${count}`;
  const lines = [`cointoss basin coin.toml --x ${axis(x)}`, `  --y ${axis(y)}`,
    `  ${after === null ? "" : `--after ${after} `}${trust ? "--trust " : ""}--out coin.zarr --png coin.png`];
  return `cat > coin.toml << 'END'\n${toml(scenario, fields)}END\n${lines.join(" \\\n")}\n`;
}

const text = (value) => (typeof value === "string" ? `"${value}"` : String(value));
