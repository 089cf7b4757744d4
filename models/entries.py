"""What Python calls of the description's compiled code; annotations say which rows of numbers are passed."""

from cointoss.models import free_joint, rows
from cointoss.models import lowest_points as lowest
from cointoss.models.kernel.library import Library

engine = Library(__name__)

examine_each = engine.entry(rows.examine_each)
states_of_joint = engine.entry(free_joint.states_of_joint)
joint_of_states = engine.entry(free_joint.joint_of_states)
lowest_points = engine.entry(lowest.lowest_points)
