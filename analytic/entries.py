"""What Python and a page call of the compiled engine; annotations say which rows of numbers are passed."""

from cointoss.analytic import by_rows, events, going_on, path, resting, seeing, striking
from cointoss.analytic.air import force
from cointoss.analytic.horizon import certainty, horizon
from cointoss.analytic.horizon import event_tangent as tangent
from cointoss.models import rows
from cointoss.models.kernel.library import Library
from cointoss.models.kernel.manifest import BROWSER, CUDA

engine = Library(__name__)

examine = engine.entry(rows.examine, BROWSER)
toss_each = engine.entry(by_rows.toss_each, BROWSER)
toss_one = engine.entry(by_rows.toss_one, BROWSER)
sample_path = engine.entry(by_rows.sample_path, BROWSER)

toss_rows = engine.entry(by_rows.toss_rows)
rest_each = engine.entry(resting.rest_each)
toss_apart = engine.entry(by_rows.toss_apart, CUDA)
toss_coin = engine.entry(events.toss_coin)
go_on = engine.entry(going_on.go_on)
find_horizon = engine.entry(horizon.find_horizon)
certainty_of = engine.entry(certainty.certainty_of)
closest_other = engine.entry(certainty.closest_other)
event_tangent = engine.entry(tangent.event_tangent)
sample_piece = engine.entry(path.sample_piece)
sample_pieces = engine.entry(path.sample_pieces)
floor_forces = engine.entry(path.floor_forces)
force_and_moment = engine.entry(force.force_and_moment)
strike_each = engine.entry(striking.strike_each)
see_each = engine.entry(seeing.see_each)
