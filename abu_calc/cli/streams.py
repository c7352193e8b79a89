"""Standard output and error that never end a command: closed, broken, full, or without half the signs.

The result of a command stands whether or not somebody reads it. A reader that has gone away wants no more and is told
nothing. A full disk is reported at the end, see `Outlet.fault`.
"""

import codecs
import io
import os
import sys
import time
from typing import Any, Final

PLAIN: Final = str.maketrans(
    {"µ": "u", "×": "x", "·": "*", "Ø": "dia ", "√": "sqrt", "…": "...", "→": "->", "−": "-", "–": "-", "±": "+-",
     "≤": "<=", "≥": ">=", "°": " deg", "²": "^2", "³": "^3", "Ω": "Omega", "ω": "omega", "Δ": "Delta", "ε": "eps",
     "β": "beta", "ρ": "rho", "σ": "sigma", "κ": "kappa", "θ": "theta", "α": "alpha", "φ": "phi", "γ": "gamma",
     "π": "pi", "₀": "0", "█": "#", "▓": "+", "▒": "=", "░": "-"}
)  # fmt: skip

BUSY_S: Final = 0.01
"""Seconds between two attempts to write to a reader that accepts nothing at the moment."""


class Outlet(io.RawIOBase):
    """The bytes of a stream on their way out. Never raises; `fault`: why some did not arrive, though one reads."""

    def __init__(self, raw: Any) -> None:
        super().__init__()
        self._raw = raw
        self._open = True
        self.fault: str | None = None

    def write(self, data: Any) -> int:
        """All of the data, or what a stream that is closed would have taken."""
        rest = memoryview(data).cast("B")
        while self._open and len(rest):
            try:
                taken = self._raw.write(rest)
            except (BrokenPipeError, ConnectionResetError):
                self._open = False
            except OSError as error:
                # Windows calls a pipe whose reader is gone an invalid argument.
                self._open = False
                self.fault = None if os.name == "nt" and error.errno == 22 else error.strerror or str(error)
            except ValueError:  # closed by somebody else
                self._open = False
            else:
                if not taken:
                    time.sleep(BUSY_S)
                rest = rest[taken or 0 :]
        return memoryview(data).nbytes

    def writable(self) -> bool:
        """True, since the outlet can always be written to."""
        return True

    def fileno(self) -> int:
        """File number of the stream."""
        number: int = self._raw.fileno()
        return number

    def isatty(self) -> bool:
        """True if the stream is a terminal."""
        return bool(self._raw.isatty())


def make_safe() -> Outlet:
    """Puts streams that never raise in the place of both; that of standard output.

    A character that a console cannot show is spelled in others; pipes on Windows get UTF-8.
    """
    codecs.register_error("spelled", _spelled)
    _fill_gaps()
    sys.stdout, outlet = _safe(sys.stdout)
    sys.stderr, _ = _safe(sys.stderr)
    return outlet


def _fill_gaps() -> None:
    """Nothing that is opened later may take the place of a stream that the shell has closed."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


def _safe(stream: Any) -> tuple[io.TextIOWrapper, Outlet]:
    buffer = getattr(stream, "buffer", None)
    if buffer is None:  # closed, or none of the system's
        outlet = Outlet(io.FileIO(os.devnull, "w"))
        return io.TextIOWrapper(io.BufferedWriter(outlet), encoding="utf-8", errors="spelled"), outlet
    outlet = Outlet(getattr(buffer, "raw", buffer))
    encoding = "utf-8" if os.name == "nt" and not outlet.isatty() else stream.encoding
    text = io.TextIOWrapper(
        io.BufferedWriter(outlet),
        encoding=encoding,
        errors="spelled",
        line_buffering=stream.line_buffering,
        write_through=stream.write_through,
    )
    return text, outlet


def _spelled(error: UnicodeError) -> tuple[str, int]:
    """Replacement of a sign that the console lacks, "?" if there is nothing better."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end].translate(PLAIN)
    return "".join(sign if sign.isascii() else "?" for sign in text), error.end
