"""Figure 5 where no stills of MuJoCo's coin can be drawn."""

import pytest

from cointoss_reproduction.frame import runner
from cointoss_reproduction.frame.claim import unexpected
from cointoss_reproduction.studies.fig5 import study as fig5


@pytest.mark.slow
def test_the_figure_comes_without_stills_too(monkeypatch, tmp_path):
    monkeypatch.setattr(fig5, "stills", lambda *_: "no library")
    result = runner.reproduce("fig5", tmp_path, lambda *_: None, quick=True)
    assert unexpected(result.claims, quick=True) == ()
    assert any("no stills: no library" in claim.mujoco for claim in result.claims)
    assert (runner.folder_of("fig5", tmp_path) / "figure.png").exists()
