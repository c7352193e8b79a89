"""LLVM by llvmlite: from its text to machine code as bytes, from bytes to functions, with a cache on disk.

llvmlite is what numba stands on, with wheels for Linux, macOS and Windows; it is imported in a tenth of numba's time.

The cache holds one file for each module, written whole and read whole, or done without. A file holds a checksum and
its content's key: one that is cut off or holds other bytes is not used, and is written anew. Files appear under their
names by a rename, so that several processes may write at once. A folder that cannot be used gives one warning, and
everything goes on without it.
"""

import contextlib
import ctypes
import hashlib
import os
import re
import secrets
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from abu_calc.foundation.escaping import shortened
from abu_calc.foundation.frozen import dataclass

FOLDER = "ABU_CALC_CACHE"
"""Environment variable that names another folder."""

MOST_BYTES = 50_000_000
"""Bytes that are kept, some thousand structures; the least recently used goes first."""

OURS = re.compile(r"[0-9a-f]{64}\.o(\.[0-9a-f]+)?")
"""Names of our files; a folder that somebody chose may hold others."""

NOWHERE = Path(os.devnull) / "no-home"
"""A folder that cannot be there, so that a warning says so."""

_told: set[str] = set()


@dataclass(frozen=True)
class Cache:
    """A folder of compiled code."""

    folder: Path

    @classmethod
    def own(cls) -> "Cache":
        """Cache in the folder where programs of this system keep what they can make again.

        A folder without a home cannot be used.
        """
        chosen = os.environ.get(FOLDER)
        try:
            return cls(Path(chosen).expanduser() if chosen else _base() / "abu-calc" / "compiled")
        except RuntimeError:  # ~somebody who is not known here
            return cls(NOWHERE / str(chosen))

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
        return self.folder / f"{key}.o"

    def _bound(self) -> None:
        """Delete what was used longest ago; others may be deleting, too."""
        files = []
        for file in self.folder.iterdir():
            if OURS.fullmatch(file.name):
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
            warnings.warn(f"compiled code is not kept: {folder}: {reason}", RuntimeWarning, stacklevel=2)


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


LEVEL = 2
"""Level of optimisation."""


class CompilerError(Exception):
    """There is no compiler here, or it does not do what it should: there are other ways."""


@contextmanager
def guarded(doing: str) -> Iterator[None]:
    """Raise CompilerError for whatever goes wrong in the library."""
    try:
        yield
    except Exception as error:
        reason = (str(error).splitlines() or [""])[0]
        raise CompilerError(f"{doing}: {type(error).__name__}: {reason}") from error


@cache
def _library() -> Any:
    """llvmlite's binding, ready for this machine; it knows the functions of C that the code calls."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    library = ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None)
    for name in ("sin", "cos", "pow"):
        llvm.add_symbol(name, ctypes.cast(getattr(library, name), ctypes.c_void_p).value)
    return llvm


@cache
def _features() -> str:
    """Features of this processor."""
    features: str = _library().get_host_cpu_features().flatten()
    return features


def _target() -> Any:
    """Target machine for this computer; each engine takes one of its own."""
    llvm = _library()
    return llvm.Target.from_triple(llvm.get_process_triple()).create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=_features(),
        opt=LEVEL,
        reloc="static" if sys.platform == "win32" else "pic",
        codemodel="jitdefault",
    )


@cache
def described() -> str:
    """Description of all that machine code depends on besides its text. Raises CompilerError."""
    with guarded("llvmlite"):
        llvm = _library()
        name = llvm.get_host_cpu_name()
        return f"{llvm.llvm_version_info} {llvm.get_process_triple()} {name} {_features()} {LEVEL}"


def compiled(text: str) -> bytes:
    """Machine code for a module in LLVM's language. Raises CompilerError."""
    with guarded("compiling"):
        llvm, target = _library(), _target()
        module = llvm.parse_assembly(text)
        module.triple, module.data_layout = llvm.get_process_triple(), str(target.target_data)
        module.verify()
        options = llvm.create_pipeline_tuning_options(speed_level=LEVEL)
        options.loop_vectorization = options.slp_vectorization = options.loop_unrolling = False
        builder = llvm.create_pass_builder(target, options)
        builder.getModulePassManager().run(module, builder)
        code: bytes = target.emit_object(module)
        return code


class LoadedModule:
    """A module in this process, in an engine of its own: two in one got each other's constants."""

    def __init__(self, code: bytes) -> None:
        with guarded("loading compiled code"):
            llvm = _library()
            self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target())
            self._engine.add_object_file(llvm.ObjectFileRef.from_data(code))
            self._engine.finalize_object()

    def address(self, name: str) -> int:
        """Address of a function. Raises CompilerError."""
        with guarded("loading compiled code"):
            pointer: int = self._engine.get_function_address(name)
        if not pointer:
            raise CompilerError(f"compiled code has no {name}")
        return pointer

    def function(self, name: str, pointers: int) -> Callable[..., int]:
        """One that takes so many arrays, by their places, and gives a whole number."""
        return ctypes.CFUNCTYPE(ctypes.c_int64, *[ctypes.c_void_p] * pointers)(self.address(name))

    def rates(self, name: str, pointers: int) -> Callable[..., None]:
        """One that takes a moment and so many arrays."""
        return ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.c_void_p] * pointers)(self.address(name))
