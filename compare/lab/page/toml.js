// A scenario as a TOML file, and the command that makes the map that is seen.

const COMPONENTS = {
  "coin.center_of_mass": ["xi", "eta", "zeta"],
  "release.position": ["x", "y", "z"],
  "release.velocity": ["x", "y", "z"],
  "release.angles": ["psi", "theta", "phi"],
  "release.quaternion": ["e0", "e1", "e2", "e3"],
  "release.angular_velocity": ["xi", "eta", "zeta"],
};
const TABLES = ["coin", "air", "floor", "release", "ending"];

export function toml(scenario, fields) {
  const lines = { "": [] };
  for (const table of TABLES) lines[table] = [];
  const done = new Set();
  for (const field of Object.keys(scenario)) {
    const [path, component] = [field.slice(0, field.lastIndexOf(".")), field.slice(field.lastIndexOf(".") + 1)];
    const vector = COMPONENTS[path], name = vector ? path : field;
    if (done.has(name)) continue;
    done.add(name);
    const value = vector
      ? `[${vector.map((each) => text(scenario[`${path}.${each}`] ?? fields[`${path}.${each}`]?.default ?? 0)).join(", ")}]`
      : text(scenario[field]);
    const [table, key] = name.includes(".") ? name.split(".") : ["", name];
    lines[table].push(`${key} = ${value}`);
  }
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
