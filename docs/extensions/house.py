"""Draw the house, docs/house.svg: the parts of each folder in layers, from the imports in the code."""

import ast
from collections import defaultdict
from pathlib import Path

import grimp

FOLDERS = ("compare", "analytic", "coin_mj", "models")
WIDTH, MARGIN, GAP = 940, 16, 8
BOX, LETTER, TOP = 28, 9.2, 46
"""Height of a box, width of a letter in it, and room for the title of a folder [px]."""
ROOF = {"compare": "#fbf3dd", "analytic": "#dcecf6", "coin_mj": "#f9e3d6", "models": "#e9e9e9"}
STYLE = "text{font:13px sans-serif;fill:#222}.t{font-weight:bold}.s{font-size:12px;fill:#555}"


def imports_of(folder: str, graph: grimp.ImportGraph) -> dict[str, set[str]]:
    """Return what each part of a folder, a module or a folder in it, imports of the other parts."""
    start = f"cointoss.{folder}"
    parts = {module: module.split(".")[2] for module in graph.find_descendants(start)}
    found: dict[str, set[str]] = {part: set() for part in parts.values()}
    for module, part in parts.items():
        for other in graph.find_modules_directly_imported_by(module):
            if parts.get(other, part) != part:
                found[part].add(parts[other])
    return found


def layers_of(imports: dict[str, set[str]]) -> list[list[str]]:
    """Return the parts in layers: each part above all that it imports, the top layer first."""
    heights: dict[str, int] = {}

    def height(part: str) -> int:
        if part not in heights:
            heights[part] = 1 + max(map(height, imports[part]), default=-1)
        return heights[part]

    layers = defaultdict(list)
    for part in sorted(imports):
        layers[height(part)].append(part)
    return [layers[level] for level in sorted(layers, reverse=True)]


def rows_of(layers: list[list[str]], width: float) -> list[list[tuple[str, float]]]:
    """Return rows of parts with their widths, none wider than `width` [px]; a layer may take several."""
    rows: list[list[tuple[str, float]]] = []
    for layer in layers:
        rows.append([])
        for part in layer:
            wide = 16 + LETTER * len(part)
            if rows[-1] and sum(w + GAP for _, w in rows[-1]) + wide > width:
                rows.append([])
            rows[-1].append((part, wide))
    return rows


def box(x: float, y: float, size: tuple[float, float], fill: str, stroke: str) -> str:
    """Return a box whose upper left corner is x, y [px]."""
    place = f'x="{x:g}" y="{y:g}" width="{size[0]:g}" height="{size[1]:g}"'
    return f'<rect {place} rx="4" fill="{fill}" stroke="{stroke}"/>'


def drawn_folder(
    folder: str, graph: grimp.ImportGraph, top: Path, x: float, y: float, width: float
) -> tuple[str, float]:
    """Return a folder's drawing, its upper left corner at x, y, and its height [px]."""
    says = ast.get_docstring(ast.parse((top / folder / "__init__.py").read_text(encoding="utf-8"))) or ""
    first = says.splitlines()[0].partition("; ")[0].rstrip(".")
    rows = rows_of(layers_of(imports_of(folder, graph)), width - 2 * GAP)
    tall = TOP + len(rows) * (BOX + GAP)
    lines = [
        box(x, y, (width, tall), ROOF[folder], "#888"),
        f'<text class="t" x="{x + GAP:g}" y="{y + 18:g}">{folder}/</text>',
        f'<text class="s" x="{x + GAP:g}" y="{y + 36:g}">{first}</text>',
    ]
    for level, row in enumerate(rows):
        left, above = x + GAP, y + TOP + level * (BOX + GAP)
        for part, wide in row:
            is_folder = (top / folder / part).is_dir()
            kind = "t" if is_folder else "m"
            lines += [
                box(left, above, (wide, BOX), "#fff", "#444" if is_folder else "#bbb"),
                f'<text class="{kind}" x="{left + 8:g}" y="{above + 19:g}">{part}</text>',
            ]
            left += wide + GAP
    return "\n".join(lines), tall


def house(top: Path) -> str:
    """Return the picture, as SVG; each part lies above what it imports."""
    graph = grimp.build_graph("cointoss", cache_dir=None)
    whole, half = WIDTH - 2 * MARGIN, (WIDTH - 3 * MARGIN) / 2
    compare, tall = drawn_folder("compare", graph, top, MARGIN, MARGIN, whole)
    y = 2 * MARGIN + tall
    analytic, left = drawn_folder("analytic", graph, top, MARGIN, y, half)
    coin_mj, right = drawn_folder("coin_mj", graph, top, 2 * MARGIN + half, y, half)
    y += max(left, right) + MARGIN
    models, tall = drawn_folder("models", graph, top, MARGIN, y, whole)
    y += tall + MARGIN
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y:g}" role="img">'
    paper = f'<rect width="{WIDTH}" height="{y:g}" fill="#fff"/>'
    return "\n".join([head, f"<style>{STYLE}</style>", paper, compare, analytic, coin_mj, models, "</svg>\n"])
