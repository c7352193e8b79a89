"""Writing of files: whole or not at all, and never over another's file that appeared meanwhile."""

import contextlib
import os
import stat
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from abu_calc.foundation.call_files import enter
from abu_calc.foundation.errors import InputError, OutputError, Place


class Target(NamedTuple):
    """A file to be written, and its text, which may come in pieces, or its bytes."""

    path: Path
    text: str | bytes | Iterable[str | bytes]


def check_target(path: Path, *, force: bool, suffixes: tuple[str, ...] = (), option: str | None = None) -> None:
    """Refuse early what could not be written later: unknown suffix, missing folder, existing file without --force, a
    file that the same call reads or writes already.

    `option`: that names the file, for errors about names that no file can have.
    """
    place = Place(str(path))
    if "\0" in str(path):
        raise OutputError("not a file name", place=place)
    if suffixes and path.suffix.lower() not in suffixes:
        picture = path.suffix.lower() in (".png", ".jpg", ".jpeg") and option == "--output"
        remedy = "Figures alone are pictures: --figure NAME=FILE.png." if picture else None
        raise OutputError(
            "unknown format", found=str(path), allowed="a name ending in " + " ".join(suffixes), remedy=remedy
        )
    try:
        if path.is_dir():
            raise OutputError("this is a folder", place=place, remedy="Give a file's name.")
        if not path.absolute().parent.is_dir():
            raise OutputError("the folder does not exist", place=place, remedy="Make it first.")
        if not os.access(_final(path).parent, os.W_OK):
            raise OutputError("the folder cannot be written", place=place, remedy="Name a file in another folder.")
        _check_kind(path)
        if os.path.lexists(path) and not force:
            raise _exists(path)
        enter(path, written=True)
    except OSError as error:
        named = Place(str(path), key=option)
        raise OutputError(f"cannot be written: {error.strerror or error}", place=named) from None


def write(targets: Iterable[Target], *, force: bool) -> None:
    """Write files, all of them beside their places first, then put into these; what can be written is.

    Without `force` none takes the place of a file, even one that has come since `check_target` looked. Symbolic links
    stay, the file they point to is replaced. Raises an error that names the files that were not written, and those that
    were.
    """
    ready: list[tuple[Path, Path]] = []
    faults, written = list[InputError](), list[str]()
    try:
        for path, text in targets:
            with _noted(faults, path):
                ready.append((_beside(path, [text] if isinstance(text, (str, bytes)) else text), path))
        for temporary, path in ready:
            with _noted(faults, path):
                _place(temporary, path, force=force)
                written.append(str(path))
    finally:
        for temporary, _ in ready:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
    if faults:
        error = faults[0] if len(faults) == 1 else OutputError("\n".join(map(str, faults)))
        named = f"Written is: {', '.join(written)}." if written else None
        error.remedy = " ".join(part for part in (error.remedy, named) if part) or None
        raise error


@contextlib.contextmanager
def _noted(faults: list[InputError], path: Path) -> Iterator[None]:
    """Note the error about one file, so that the others are written."""
    try:
        yield
    except InputError as error:
        faults.append(error)
    except OSError as error:
        faults.append(OutputError(f"cannot be written: {error.strerror or error}", place=Place(str(path))))


def _exists(path: Path) -> OutputError:
    remedy = "Choose another name, or overwrite it with --force."
    return OutputError("exists already", place=Place(str(path)), remedy=remedy)


def _check_kind(path: Path) -> None:
    """Refuse pipes, devices and sockets: nothing can be put into their place."""
    with contextlib.suppress(FileNotFoundError):
        if not stat.S_ISREG(path.stat().st_mode):
            raise OutputError("this is not a regular file", place=Place(str(path)), remedy="Give a file's name.")


def _beside(path: Path, pieces: Iterable[str | bytes]) -> Path:
    """A file with the text in UTF-8, in the folder where it will stand."""
    final = _final(path)
    handle, name = tempfile.mkstemp(prefix=".abu-", suffix=final.suffix, dir=final.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.writelines(piece.encode("utf-8", "replace") if isinstance(piece, str) else piece for piece in pieces)
        Path(name).chmod(stat.S_IMODE(final.stat().st_mode) if final.exists() else 0o666 & ~_umask())
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return Path(name)


def _final(path: Path) -> Path:
    """Target of a path, through symbolic links."""
    return Path(os.path.realpath(path)) if path.is_symlink() else path.absolute()


def _place(temporary: Path, path: Path, *, force: bool) -> None:
    """Put a file into its place, in one step."""
    _check_kind(path)
    if force:
        temporary.replace(_final(path))
        return
    try:
        _put_alone(temporary, path)
    except FileExistsError:
        raise _exists(path) from None


def _put_alone(temporary: Path, path: Path) -> None:
    """The same where nothing stands yet; raises FileExistsError where something does."""
    if os.name == "nt":
        temporary.rename(path)  # which there replaces nothing
        return
    try:
        path.hardlink_to(temporary)
    except FileExistsError:
        raise
    except OSError:  # a system of files without links: take the name first
        os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
        temporary.replace(path)


def _umask() -> int:
    current = os.umask(0)
    os.umask(current)
    return current
