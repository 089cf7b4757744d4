"""How records look in a notebook: HTML with a picture as SVG, readable on light and on dark."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape

from cointoss.models.palette import COLORS

WIDTH, HEIGHT, EDGE = 560, 150, 22
"""Of a picture, and its margin [pixels]."""
_OTHER = "#8a8f98"
MOST_SHOWN = 60
"""Faces of a sequence, and impacts, in one line or picture."""


def shortened(sequence: str, most: int = MOST_SHOWN) -> str:
    """Return a sequence for a person: its first `most` symbols and how many are left out."""
    left_out = len(sequence) - most
    return sequence if left_out <= 0 else f"{sequence[:most]} ... and {left_out} more"


def with_bar(sequence: str, trusted: int) -> str:
    """Return a sequence with a bar after the impacts that can be trusted, where others follow."""
    return sequence if trusted >= len(sequence) else f"{sequence[:trusted]}|{sequence[trusted:]}"


def block(title: str, picture: str, facts: Mapping[str, str]) -> str:
    """Return a title, a picture and a table of facts as HTML."""
    rows = "".join(
        f'<tr><th style="text-align:left;padding-right:1em">{escape(name)}</th>'
        f'<td style="text-align:left;overflow-wrap:anywhere">{escape(fact)}</td></tr>'
        for name, fact in facts.items()
    )
    return f"<div><strong>{escape(title)}</strong><br>{picture}<table>{rows}</table></div>"


def path_picture(
    path: Iterable[tuple[float, float]],
    touches: Sequence[tuple[float, float, str]],
    trusted_until: float | None,
) -> str:
    """Return the height of a coin over time as SVG, marked where it touches the floor.

    Args:
        path: times [s] and heights [m].
        touches: time [s], height [m] and the face that is up, "heads" or "tails"; the first are drawn.
        trusted_until: where the horizon of trust is drawn [s]; None for nowhere.
    """
    points = list(path)
    end, top = max(points[-1][0], 1e-12), max(*(z for _, z in points), 1e-12)

    def place(t: float, z: float) -> tuple[float, float]:
        return EDGE + (WIDTH - 2 * EDGE) * t / end, HEIGHT - EDGE - (HEIGHT - 2 * EDGE) * z / top

    line = " ".join("{:.1f},{:.1f}".format(*place(t, z)) for t, z in points)
    marks = "".join(
        '<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="{}"><title>{} up at {:.6g} s</title></circle>'.format(
            *place(t, z), COLORS[face], face, t
        )
        for t, z, face in touches[:MOST_SHOWN]
    )
    horizon = ""
    if trusted_until is not None:
        x, _ = place(trusted_until, 0)
        horizon = f'<line x1="{x:.1f}" x2="{x:.1f}" y1="4" y2="{HEIGHT - EDGE}" stroke-dasharray="4 3"/>'
    floor = f'<line x1="{EDGE}" x2="{WIDTH - EDGE}" y1="{HEIGHT - EDGE}" y2="{HEIGHT - EDGE}"/>'
    return _picture(
        "height of the mass centre over time",
        HEIGHT,
        f'{floor}{horizon}<polyline points="{line}"/>{marks}'
        f"{_text(EDGE, HEIGHT - 6, '0 s')}{_text(WIDTH - EDGE, HEIGHT - 6, f'{end:.4g} s', 'end')}"
        f"{_text(EDGE, 14, f'{top:.4g} m')}",
    )


def shares_picture(shares: Mapping[str, float]) -> str:
    """Return a bar of the shares of outcomes as SVG."""
    left, parts = 0.0, []
    for name, share in shares.items():
        color = COLORS.get(name, _OTHER)
        parts.append(
            f'<rect x="{WIDTH * left:.1f}" y="0" width="{WIDTH * share:.1f}" height="24" fill="{color}" '
            f'stroke="none"><title>{escape(name)}: {share:.3%}</title></rect>'
        )
        left += share
    told = ", ".join(f"{name} {share:.1%}" for name, share in shares.items())
    return _picture(f"shares: {told}", 24, "".join(parts))


def _picture(about: str, height: int, drawn: str) -> str:
    return (
        f'<svg role="img" aria-label="{escape(about)}" viewBox="0 0 {WIDTH} {height}" '
        f'style="max-width:{WIDTH}px;width:100%" fill="none" stroke="currentColor">{drawn}</svg>'
    )


def _text(x: float, y: float, text: str, anchor: str = "start") -> str:
    return (
        f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="currentColor" stroke="none" '
        f'style="font:12px sans-serif">{escape(text)}</text>'
    )
