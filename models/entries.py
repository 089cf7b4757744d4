"""What Python calls of the description's compiled code; annotations say which rows of numbers are passed."""

from cointoss.models import attitude, free_joint, hand_states, restitution, rows, spring
from cointoss.models import lowest_points as lowest
from cointoss.models.kernel.library import Library

engine = Library(__name__)

quaternion_from_angles = engine.entry(attitude.quaternion_from_angles)
turn_each = engine.entry(attitude.turn_each)
roll_each = engine.entry(rows.roll_each)
write_attitudes = engine.entry(rows.write_attitudes)
body_in_any_air = engine.entry(rows.body_in_any_air)
rules_of = engine.entry(rows.rules_of)
examine = engine.entry(rows.examine)
examine_each = engine.entry(rows.examine_each)
largest_restitution = engine.entry(restitution.largest_restitution)
damping_ratio_of = engine.entry(spring.damping_ratio_of)
tossed_states = engine.entry(hand_states.tossed_states)
spun_states = engine.entry(hand_states.spun_states)
states_of_joint = engine.entry(free_joint.states_of_joint)
joint_of_states = engine.entry(free_joint.joint_of_states)
lowest_points = engine.entry(lowest.lowest_points)
