"""Closed, broken and full streams, and signals: the result keeps its meaning, nothing misleading is said."""

import io
import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from abu_calc.cli.streams import Outlet
from tests.inputs.samples import BEARINGS

posix = pytest.mark.skipif(os.name == "nt", reason="shells of POSIX")
FAILING = ("check-fit", *["--designation", "7516", "--radial-load-kN", "3", "--shaft", "f6", "--housing", "H7"])
"""A quick command whose checks fail; `presets` is one that passes."""


def shell(line: str) -> subprocess.CompletedProcess[str]:
    """A line of a shell, in which abu stands for the command."""
    abu = f"{shlex.quote(sys.executable)} -m abu_calc"
    return subprocess.run(["bash", "-c", line.replace("abu ", f"{abu} ")], capture_output=True, text=True, check=False)


@pytest.mark.few(1)
@posix
@pytest.mark.parametrize(
    ("line", "status"),
    [
        ("abu presets | true; exit ${PIPESTATUS[0]}", 0),
        (f"abu {' '.join(FAILING)} --json | true; exit ${{PIPESTATUS[0]}}", 1),
        ("abu --help | true; exit ${PIPESTATUS[0]}", 0),
        (f"abu {' '.join(FAILING)} >&-", 1),
        ("abu presets >&- 2>&- <&-", 0),
    ],
)
@pytest.mark.slow
def test_nobody_reads_on(line: str, status: int) -> None:
    done = shell(line)
    assert (done.returncode, done.stderr) == (status, "")


@posix
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.slow
def test_a_full_disk_is_told_with_what_was_computed() -> None:
    done = shell(f"abu {' '.join(FAILING)} > /dev/full")
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1 and "standard output cannot be written" in done.stderr
    assert "a check failed or could not be done" in done.stderr


@pytest.mark.few(1)
@posix
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
@pytest.mark.slow
def test_signals_end_a_command_in_good_order(name: str, tmp_path: Path) -> None:
    """One line, 128 and the number, and nothing written."""
    number = getattr(signal, name)
    # The process sends itself the signal in the middle of the work, so that no time has to be guessed; in code made
    # from text, out of which a KeyboardInterrupt would end the process by the signal itself.
    code = (
        "import os, signal\nfrom abu_calc.features.seats import study as check_fit\n"
        "from abu_calc.cli.start import main\n"
        f"signal.signal({int(number)}, signal.SIG_DFL)\n"  # whoever runs the tests may have it ignored
        f"check_fit.judged_seats = lambda *_: exec('os.kill(os.getpid(), {int(number)})')\nmain()"
    )
    command = (sys.executable, "-c", code, *FAILING, "--output", str(tmp_path / "out.json"))
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (128 + number, "")
    assert done.stderr == "Interrupted; nothing was written.\n"
    assert list(tmp_path.iterdir()) == []


@posix
@pytest.mark.parametrize(
    ("before", "status"),
    [
        ("for name in ENDING: vars(signal).pop(name)", -1),  # a system without these signals does without
        ("signal.signal(1, signal.SIG_IGN)", 0),  # what is ignored stays ignored, as nohup asks
    ],
)
def test_signals_that_are_not_to_be_heeded_are_not(before: str, status: int) -> None:
    """Of a process that heeds signals after this code, then sends itself SIGHUP."""
    code = (
        "import os, signal\nfrom abu_calc.foundation.parallel import heed_signals\n"
        "ENDING = 'SIGINT', 'SIGTERM', 'SIGHUP'\nsignal.signal(1, signal.SIG_DFL)\n"
        f"{before}\nheed_signals()\nos.kill(os.getpid(), 1)"
    )
    assert subprocess.run((sys.executable, "-c", code), check=False).returncode == status


class Raising(io.RawIOBase):
    """A stream that takes a byte at a time, then none, then fails."""

    def __init__(self, error: Exception) -> None:
        super().__init__()
        self.taken, self.error = b"", error

    def write(self, data: object) -> int | None:
        """One byte, every second time none."""
        if len(self.taken) == 3:
            raise self.error
        one = bytes(data)[:1]  # type: ignore[call-overload]
        if self.taken[-1:] == one:
            return None
        self.taken += one
        return 1


@pytest.mark.parametrize(
    ("error", "fault"),
    [
        (BrokenPipeError(), None),
        (ConnectionResetError(), None),
        (ValueError("closed"), None),
        (OSError(28, "No space left on device"), "No space left on device"),
    ],
)
def test_an_outlet_takes_all_and_raises_nothing(error: Exception, fault: str | None) -> None:
    outlet = Outlet(raw := Raising(error))
    assert outlet.write(b"abcdef") == 6 and outlet.write(b"more") == 4
    assert (raw.taken, outlet.fault) == (b"abc", fault)


@posix
@pytest.mark.slow
def test_consoles_of_few_signs_get_others(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(BEARINGS.replace("fleshing", "µ²\\uD7FF"), encoding="utf-8")
    done = shell(f"LC_ALL=C PYTHONUTF8=0 PYTHONIOENCODING=ascii COLUMNS=0 TERM= abu check-fit {file}")
    assert done.returncode in (0, 1) and done.stderr == "" and "u^2?" in done.stdout
