"""A fit as a figure: the toss with what was seen, and the residuals below."""

from matplotlib import rc_context
from matplotlib.figure import Figure

from cointoss.compare.fitting.fit import Fit
from cointoss.compare.output.style import BLUE, GREY, PALE, STYLE


def draw_fit(fit: Fit) -> Figure:
    """Draw a fit, and below it by how many standard deviations it misses each number."""
    with rc_context(STYLE):
        picture = Figure(figsize=(7, 5))
        above, below = picture.subplots(2, 1, height_ratios=(3, 1.3), sharex=True)
        fit.plot(above).set(xlabel="")
        can = "can" if fit.is_possible else "cannot"
        above.set_title(f"this model {can} do what was seen", pad=16)
        below.axhspan(-2, 2, color=PALE, alpha=0.25)
        below.axhline(0, color=GREY, linewidth=0.8)
        for chosen, color in ((fit.tested, BLUE), (~fit.tested, PALE)):
            below.plot(fit.times[chosen], fit.residuals[chosen], "o", color=color, markersize=3.5)
        below.set(xlabel="observer's time [s]", ylabel="residual [sd]")
        return picture
