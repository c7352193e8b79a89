"""A folder where this program keeps what it can make again: compiled code, banks of simulated starts.

It holds one file for each piece, written whole and read whole, or done without. A file holds a checksum and its
content's key: one that is cut off or holds other bytes is not used, and is written anew. Files appear under their
names by a rename, so that several processes may write at once. A folder that cannot be used gives one warning, and
everything goes on without it.
"""

import contextlib
import hashlib
import os
import re
import secrets
import sys
import warnings
from pathlib import Path

from abu_calc.foundation.errors import shortened
from abu_calc.foundation.frozen import dataclass

FOLDER = "ABU_CALC_CACHE"
"""Environment variable that names another folder."""

MOST_BYTES = 50_000_000
"""Bytes of a kind that are kept; the least recently used goes first."""

NOWHERE = Path(os.devnull) / "no-home"
"""A folder that cannot be there, so that a warning says so."""

_told: set[str] = set()


@dataclass(frozen=True)
class Cache:
    """A folder of pieces of one kind; `kept`: what they are, for the warning; `suffix`: of their files."""

    folder: Path
    kept: str = "compiled code is"
    suffix: str = "o"

    @classmethod
    def own(cls, name: str = "compiled", kept: str = "compiled code is", suffix: str = "o") -> "Cache":
        """Cache in the folder where programs of this system keep what they can make again.

        A folder without a home cannot be used.
        """
        chosen = os.environ.get(FOLDER)
        try:
            return cls(Path(chosen).expanduser() if chosen else _base() / "abu-calc" / name, kept, suffix)
        except RuntimeError:  # ~somebody who is not known here
            return cls(NOWHERE / str(chosen), kept, suffix)

    def read(self, key: str) -> bytes | None:
        """Content written under a key; None if it is missing or incomplete."""
        try:
            data = self.place(key).read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            self._unusable(error)
            return None
        digest, content = data[:32], data[32:]
        if _digest(key, content) != digest:
            return None
        with contextlib.suppress(OSError):
            os.utime(self.place(key))
        return content

    def write(self, key: str, content: bytes) -> None:
        """Keep it, if that can be done."""
        place = self.place(key)
        passing = place.with_name(f"{place.name}.{secrets.token_hex(8)}")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            try:
                passing.write_bytes(_digest(key, content) + content)
                passing.replace(place)
            finally:
                passing.unlink(missing_ok=True)
            self._bound()
        except OSError as error:
            if self.read(key) != content:  # nobody else has written it either
                self._unusable(error)

    def place(self, key: str) -> Path:
        """The file of a key."""
        return self.folder / f"{key}.{self.suffix}"

    def _bound(self) -> None:
        """Delete what was used longest ago; others may be deleting, too."""
        files, ours = [], re.compile(rf"[0-9a-f]{{64}}\.{self.suffix}(\.[0-9a-f]+)?")  # others may be there, too
        for file in self.folder.iterdir():
            if ours.fullmatch(file.name):
                with contextlib.suppress(FileNotFoundError):
                    files.append((file.stat().st_mtime, file.stat().st_size, file))
        total = sum(size for _, size, _ in files)
        for _, size, file in sorted(files):
            if total <= MOST_BYTES:
                return
            file.unlink(missing_ok=True)
            total -= size

    def _unusable(self, error: OSError) -> None:
        if str(self.folder) not in _told:
            _told.add(str(self.folder))
            reason = error.strerror or type(error).__name__
            folder = shortened(str(self.folder))
            warnings.warn(f"{self.kept} not kept: {folder}: {reason}", RuntimeWarning, stacklevel=2)


def _digest(key: str, content: bytes) -> bytes:
    """Digest of the content under this key; a file under another key's name does not match it."""
    return hashlib.sha256(key.encode() + content).digest()


def _base() -> Path:
    """Cache folder of this system; nowhere if there is no home."""
    places = {"win32": ("LOCALAPPDATA", "~/AppData/Local"), "darwin": ("", "~/Library/Caches")}
    variable, usual = places.get(sys.platform, ("XDG_CACHE_HOME", "~/.cache"))
    chosen = os.environ.get(variable, "") if variable else ""
    try:
        if not chosen and os.environ.get("HOME") == "":
            raise RuntimeError
        return Path(chosen or usual).expanduser()
    except RuntimeError:
        return NOWHERE
