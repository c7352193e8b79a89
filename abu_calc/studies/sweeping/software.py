"""Software that members hang on: abu-calc with its source, the compiler of its kernels, libraries of numbers."""

import os
import platform
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Final

from abu_calc.version import __version__

LIBRARIES: Final = ("numpy", "scipy", "llvmlite")
SOURCES: Final = (".py", ".toml", ".csv")
"""Suffixes of the files that numbers come from."""


def versions(*names: str) -> dict[str, str]:
    """Versions of this program and of libraries; "none" if a library is not installed."""
    return {"abu-calc": __version__, **{name: _version(name) for name in names}}


@cache
def software() -> dict[str, str]:
    """Versions here, with a digest of abu-calc's source: two states of one version compute different members."""
    return {**versions(*LIBRARIES), "source": _source()}


def worker_name() -> str:
    """Name of this process, as stores and errors give it."""
    return f"{platform.node()}:{os.getpid()}"


def differences_of_software(here: Mapping[str, str], there: Mapping[str, str]) -> str:
    """Differences of software, in words; empty if there are none.

    >>> differences_of_software({"numpy": "2.3", "scipy": "1.16"}, {"numpy": "2.1", "scipy": "1.16"})
    'numpy 2.1, here 2.3'
    """
    names = [name for name in dict.fromkeys((*here, *there)) if here.get(name) != there.get(name)]
    return ", ".join(f"{name} {there.get(name, 'unknown')}, here {here.get(name, 'unknown')}" for name in names)


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "none"


def _source() -> str:
    """Digest of the package's files, whatever a system ends their lines with; presets are input."""
    package, digest = Path(__file__).parents[2], sha256()
    for path in sorted(each for each in package.rglob("*") if each.suffix in SOURCES):
        parts = path.relative_to(package).parts
        if parts[0] != "presets":
            digest.update("/".join(parts).encode() + b"\0" + path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return digest.hexdigest()[:12]
