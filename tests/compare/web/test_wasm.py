"""Building the engine for a browser: what is refused, in a line; tests/site tests what it makes."""

import os
import subprocess
import sys

import pytest

from cointoss.compare.web.wasm import build as building
from cointoss.compare.web.wasm import carried
from cointoss.compare.web.wasm.build import _leb128, main
from cointoss.compare.web.wasm.carried import engine_bytes, made_of, sources


@pytest.mark.parametrize("content", [b"", b"cointoss{", b'cointoss{"version": "1"}', b"\0asm" + bytes(100)])
def test_a_file_of_other_sources_is_not_carried(content, monkeypatch, tmp_path):
    assert made_of(content) == ""
    monkeypatch.setattr(carried.resources, "files", lambda _: tmp_path)
    assert engine_bytes() is None
    (tmp_path / "engine.wasm").write_bytes(content)
    assert engine_bytes() is None
    about = f'{{"sources": "{sources()}"}}'
    (tmp_path / "engine.wasm").write_bytes(whole := content + b"cointoss" + about.encode())
    assert engine_bytes() == whole


def test_numbers_are_written_seven_bits_a_byte():
    assert [_leb128(number) for number in (0, 127, 128, 300)] == [b"\0", b"\x7f", b"\x80\1", b"\xac\2"]


@pytest.mark.parametrize("arguments", [[], ["a.wasm", "b.wasm"]])
def test_one_file_is_named(arguments, capsys):
    assert main(arguments) == 2
    assert capsys.readouterr().err == "usage: python -m cointoss.compare.web.wasm.build FILE\n"


def test_without_its_linker_it_says_what_to_install(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(building, "find_spec", lambda _: None)
    assert main([str(tmp_path / "engine.wasm")]) == 2
    said = "engine.wasm: ziglang is missing, which links WebAssembly: pip install --group docs\n"
    assert capsys.readouterr().err == said
    assert list(tmp_path.iterdir()) == []


def test_another_numba_or_compiler_is_refused(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(building, "find_spec", lambda _: True)
    monkeypatch.setattr(building, "numba_version", lambda: "0.64.0")
    assert main([str(tmp_path / "engine.wasm")]) == 2
    assert capsys.readouterr().err.startswith("engine.wasm: numba 0.64.0: accepted for WebAssembly: ")
    script = f"""
import sys
from cointoss.models.kernel import libm
libm.read_code = lambda: b"built"
from cointoss.compare.web.wasm import build
build.find_spec = lambda _: True
sys.exit(build.main([{str(tmp_path / "engine.wasm")!r}]))
"""
    asked = [sys.executable, "-c", script]
    plain = {**os.environ, "COINTOSS_COMPILER": "plain"}
    done = subprocess.run(asked, env=plain, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert line.startswith("engine.wasm: ")
    assert "COINTOSS_COMPILER unset" in line
