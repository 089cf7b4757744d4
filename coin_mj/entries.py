"""What Python calls of the compiled engine; annotations are the kinds of the rows."""

from cointoss.coin_mj import by_rows, events, sampling
from cointoss.coin_mj.model import air
from cointoss.coin_mj.steps import constrained_step
from cointoss.models.kernel.library import Library

engine = Library(__name__, lacks_none=True)

toss_rows = engine.entry(by_rows.toss_rows)
rest_each = engine.entry(by_rows.rest_each)
toss_coin = engine.entry(events.toss_coin)
go_on = engine.entry(events.go_on)
sample_path = engine.entry(sampling.sample_path)
knot_forces = engine.entry(sampling.knot_forces)
air_force = engine.entry(air.air_force)
forward = engine.entry(constrained_step.forward)
