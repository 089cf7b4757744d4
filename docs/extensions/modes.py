"""Draw the hybrid automaton, docs/automaton.svg, from the legal pairs of modes and events in the code."""

from collections import defaultdict

from cointoss.analytic.contact.automaton import Event, Mode, mode_after

GROUP = "contact at one rim"
ROOMS = {
    "FLIGHT": (210, 70, 190, 44),
    "TOUCHING": (800, 70, 190, 44),
    GROUP: (505, 265, 530, 110),
    "UPRIGHT": (800, 460, 190, 44),
    "ENDED": (210, 460, 190, 44),
}
"""Centre, width and height of each box [px]."""
ONE_RIM = {"SLIDING": 335, "INCIPIENT_SLIP": 505, "STICKING": 675}
"""The modes of contact at one rim, which the same events end, and where they stand in their box [px]."""
ASIDE, LINE = 14, 15
"""How far the two arrows between a pair of boxes stand apart, and a line of text from the next [px]."""
STYLE = (
    "text{font:13px sans-serif;fill:#222;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:0}"
    ".t{font-weight:bold}.s{font-size:12px;fill:#0D5CA8}.e{font-size:12px;fill:#0D5CA8;stroke-width:5px}"
    "path{stroke:#5b6675;fill:none;stroke-width:1.4;marker-end:url(#end)}"
)
HEAD = (
    '<marker id="end" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8" '
    'orient="auto">'
    '<polygon points="0,0 10,5 0,10" fill="#5b6675"/></marker>'
)


def room_of(mode: Mode) -> str:
    """Return the box that a mode is in."""
    return GROUP if mode.name in ONE_RIM else mode.name


def arrows() -> tuple[dict[tuple[str, str], list[str]], dict[str, list[str]]]:
    """Return the events on the way from each box to each, and those after which each mode starts."""
    between: dict[tuple[str, str], list[str]] = defaultdict(list)
    before: dict[str, list[str]] = defaultdict(list)
    for event in Event:
        for mode in Mode:
            try:
                after = Mode(mode_after(mode.value, event))
            except ValueError:
                continue
            pair = room_of(mode), room_of(after)
            between[pair] += [] if event.name in between[pair] else [event.name]
            before[after.name] += [] if event.name in before[after.name] else [event.name]
    return between, before


def on_border(room: str, x: float, y: float) -> tuple[float, float]:
    """Return where the line from a box's centre towards a point leaves the box [px]."""
    cx, cy, wide, tall = ROOMS[room]
    dx, dy = x - cx, y - cy
    part = min(wide / 2 / abs(dx) if dx else 1e9, tall / 2 / abs(dy) if dy else 1e9)
    return cx + part * dx, cy + part * dy


def box(cx: float, cy: float, wide: float, tall: float, fill: str) -> str:
    """Return a box about a centre [px]."""
    place = f'x="{cx - wide / 2:g}" y="{cy - tall / 2:g}" width="{wide:g}" height="{tall:g}"'
    return f'<rect {place} rx="8" fill="{fill}" stroke="#5b6675"/>'


def text(x: float, y: float, lines: list[str], kind: str) -> str:
    """Return lines of text about a point [px]."""
    top = y - LINE * (len(lines) - 1) / 2 + 4
    return "\n".join(
        f'<text class="{kind}" x="{x:.0f}" y="{top + LINE * k:.0f}">{line}</text>'
        for k, line in enumerate(lines)
    )


def arrow(start: str, end: str, events: list[str], aside: float) -> str:
    """Return the arrow from one box to another, or back to itself, and its events.

    Args:
        start: a box.
        end: likewise.
        events: on the way.
        aside: how far it stands off the line between the centres [px].
    """
    (ax, ay, wide, _), (bx, by, _, _) = ROOMS[start], ROOMS[end]
    if start == end:
        x, y = ax - wide / 2, ay
        loop = (
            f'<path d="M{x:g},{y - 12:g} C{x - 70:g},{y - 40:g} {x - 70:g},{y + 40:g} {x - 2:g},{y + 12:g}"/>'
        )
        return loop + text(x - 56, y, events, "e")
    (x0, y0), (x1, y1) = on_border(start, bx, by), on_border(end, ax, ay)
    y0, y1 = y0 + aside, y1 + aside
    label = text((x0 + x1) / 2, (y0 + y1) / 2, events, "e")
    return f'<path d="M{x0:.0f},{y0:.0f} L{x1:.0f},{y1:.0f}"/>{label}'


def automaton() -> str:
    """Return the picture, as SVG."""
    between, before = arrows()
    parts = [box(*ROOMS[room], "#e9e9e9" if room == "ENDED" else "#fff") for room in ROOMS]
    for room, (x, y, _, tall) in ROOMS.items():
        parts.append(text(x, y - tall / 2 + 16 if room == GROUP else y, [room], "t"))
    for name, x in ONE_RIM.items():
        started = f"after {', '.join(before[name])}"
        parts += [box(x, 280, 150, 52, "#dcecf6"), text(x, 268, [name], "t"), text(x, 290, [started], "s")]
    for (start, end), events in between.items():
        both = (end, start) in between and start != end
        if (start, end) != (GROUP, GROUP):
            parts.append(arrow(start, end, events, (ASIDE if start < end else -ASIDE) if both else 0.0))
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 940 510" role="img">'
    style = f"<style>{STYLE}</style><defs>{HEAD}</defs>"
    return "\n".join([head, style, '<rect width="940" height="510" fill="#fff"/>', *parts, "</svg>\n"])
