"""Where MuJoCo's numbers lie: as a search of its memory finds them; a new layout ends in one clear line."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import ctypes
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from cointoss.coin_mj.model import memory
from cointoss.coin_mj.model.memory import LayoutError, joint_addresses, offset_of, require_layout
from tests.helpers.command_line import refused


@pytest.fixture
def machine():
    """A ball in contact with the floor: MuJoCo's model and data."""
    return memory.in_contact()


@pytest.fixture
def described(monkeypatch):
    """A copy of MuJoCo's descriptions to change."""
    structs = {name: SimpleNamespace(fields=list(s.fields)) for name, s in memory.STRUCTS.items()}
    monkeypatch.setattr(memory, "STRUCTS", structs)
    memory.layout_of.cache_clear()
    yield structs
    memory.layout_of.cache_clear()


def places(struct, name, value):
    """Find a value in the whole of a struct."""
    size = ctypes.sizeof(memory.layout_of(name))
    held, step = ctypes.string_at(struct._address, size), ctypes.alignment(value)
    return [at for at in range(0, size - step + 1, step) if held.startswith(bytes(value), at)]


def test_arrays_and_numbers_lie_where_a_search_finds_them_and_nowhere_else(machine):
    model, data = machine
    for name in ("qpos", "qvel", "qfrc_passive", "efc_J", "efc_pos", "efc_D", "efc_R", "efc_aref"):
        # The first array has the address of their buffer too.
        known = ("buffer", "qpos") if name == "qpos" else (name,)
        address = ctypes.c_size_t(getattr(data, name).ctypes.data)
        assert places(data, "mjData", address) == [offset_of("mjData", each) for each in known]
    step, time = ctypes.c_double(model.opt.timestep), ctypes.c_double(data.time)
    assert places(model, "mjModel", step) == [offset_of("mjModel", "opt.timestep")]
    assert places(data, "mjData", time) == [offset_of("mjData", "time")]
    assert data.nefc > 0
    assert offset_of("mjData", "nefc") in places(data, "mjData", ctypes.c_int32(data.nefc))


def test_the_arrays_of_the_joint_lie_at_their_addresses(machine):
    _, data = machine
    for name, address in joint_addresses(data)._asdict().items():
        array = getattr(data, name)
        array[:] = np.random.default_rng(len(name)).normal(size=array.size)
        assert ctypes.string_at(address, array.nbytes) == array.tobytes()


@pytest.mark.parametrize(
    ("struct", "place", "named"),
    # Before those used, and behind them.
    [
        ("mjData", 0, "qpos"),
        ("mjModel", 0, "opt.timestep"),
        ("mjData", -2, "signature"),
        ("mjModel", -2, "signature"),
    ],
)
def test_a_field_more_than_described_is_noticed(machine, described, struct, place, named):
    del described[struct].fields[place]
    expected = rf"^MuJoCo {mujoco.__version__}: {struct}\.{named} does not lie where .*; accepted: "
    with pytest.raises(LayoutError, match=expected):
        require_layout(*machine)


@pytest.mark.parametrize("field", ["time", "nefc", "qpos", *memory.OF_ROWS])
def test_each_field_that_is_used_is_compared(machine, described, field):
    """Two fields of one size change places: all others, and the size, stay as they were."""
    fields, layout = described["mjData"].fields, memory.layout_of("mjData")
    names = [one.name for one in fields]
    sizes = {name: getattr(layout, name).size for name in names}
    at = names.index(field)
    other = next(i for i, name in enumerate(names) if i != at and sizes[name] == sizes[field])
    fields[at], fields[other] = fields[other], fields[at]
    memory.layout_of.cache_clear()
    with pytest.raises(LayoutError, match=r"mjData\.[a-zA-Z_]+ does not lie"):
        require_layout(*machine)


def test_a_field_that_is_gone_or_of_an_unknown_type_is_named(described):
    described["mjData"].fields = [field for field in described["mjData"].fields if field.name != "efc_J"]
    with pytest.raises(LayoutError, match=r"mjData\.efc_J"):
        offset_of("mjData", "efc_J")
    described["mjModel"].fields[0] = SimpleNamespace(name="nq", type=SimpleNamespace(name="quadruple"))
    with pytest.raises(LayoutError, match=r"mjModel\.nq"):
        offset_of("mjModel", "opt.timestep")


def test_a_new_layout_is_one_line_and_exit_status_2(described):
    del described["mjData"].fields[0]
    said = refused("toss", "fig24a", "--engine", "mujoco")
    assert said.startswith(f"cointoss: MuJoCo {mujoco.__version__}: mjData.qpos does not lie")
