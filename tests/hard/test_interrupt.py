"""Ctrl-C: a line, the exit status of an interrupt, and nothing written by half."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from abu_calc.cli import app, start
from abu_calc.dynamics.integrators.compiled import code
from abu_calc.foundation.parallel import INTERRUPTED
from tests.cli.runner import abu
from tests.inputs.scenes import SCENE

pytestmark = pytest.mark.hard


def _heed_interrupts() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no SIGINT for one process")
@pytest.mark.parametrize("integrator", ["scipy", "compiled"])
def test_a_long_simulation_is_interrupted(integrator: str, tmp_path: Path) -> None:
    """Hours of work end within seconds of the signal: one line, no traceback, status 130, and the folder as before.

    However slow the machine: while it still imports, Python itself may end with the signal, which shells call 130 too.
    """
    if integrator == "compiled" and not code.installed():
        pytest.skip("compiled code was not tried on this system")
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.replace("duration_s = 700.0", "duration_s = 1000000.0"), encoding="utf-8")
    files = [f"--output={tmp_path / 'out.json'}", f"--trajectory={tmp_path / 'motion.csv'}"]
    files.append("--most-evaluations=1000000000000")
    command = sys.executable, "-m", "abu_calc", "simulate", str(scene), "--accuracy", "1e-6", "--integrator", integrator
    # Whoever runs these tests in the background may have turned the signal off.
    with subprocess.Popen(
        (*command, *files), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=_heed_interrupts
    ) as process:
        time.sleep(3)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        try:
            out, err = process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode in (INTERRUPTED, -signal.SIGINT)
    assert (out, err) == ("", "Interrupted; nothing was written.\n")
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


def _interrupt(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def test_interrupted_while_starting(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Before the command has begun, too."""
    monkeypatch.setattr(app, "main", _interrupt)
    with pytest.raises(SystemExit) as left:
        start.main()
    assert left.value.code == INTERRUPTED == 130
    assert capsys.readouterr() == ("", "Interrupted.\n")


def test_interrupted_in_the_audit(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The second run of `--audit` is as long as the first: what is told to be unwritten is not written before it."""
    monkeypatch.setattr("abu_calc.features.simulate.study.with_all_effects", _interrupt)
    scene, motion = tmp_path / "scene.toml", tmp_path / "motion.csv"
    scene.write_text(SCENE, encoding="utf-8")
    seen = abu("simulate", str(scene), "--duration", "10", "--audit", "--trajectory", str(motion))
    assert (seen.status, seen.err) == (INTERRUPTED, "Interrupted; nothing was written.\n")
    assert not motion.exists()
