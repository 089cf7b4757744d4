"""The colours of outcomes, in which all that is drawn shows them."""

HEADS, TAILS = "#F5AB1F", "#0D5CA8"
"""The coin's faces, gold and blue, as in models/coin.xml; they differ in brightness too."""
EDGE, PERPETUAL, TRANSIENT, UNDECIDED = "#009E73", "#CC79A7", "#56B4E9", "#FFFFFF"
"""Four of Okabe and Ito's colours, which the colour-blind can distinguish; and white, as paper."""
COLORS = {
    "undecided": UNDECIDED,
    "heads": HEADS,
    "tails": TAILS,
    "edge": EDGE,
    "perpetual": PERPETUAL,
    "transient": TRANSIENT,
}
"""The colours of the outcomes, by their words."""
