"""The machine files that come with the package."""

from pathlib import Path
from typing import Final

from abu_calc.errors import InputError

SUFFIX: Final = ".toml"


def folder() -> Path:
    """Folder of the presets: inside the installed package, or beside it in a checkout."""
    package = Path(__file__).resolve().parent.parent
    inside = package / "presets"
    return inside if inside.is_dir() else package.parent / "presets"


def names() -> tuple[str, ...]:
    """The names of all presets, in alphabetical order: their files without suffix."""
    return tuple(sorted(path.stem for path in folder().glob(f"*{SUFFIX}")))


def text_of(name: str) -> str:
    """The text of a preset. Raises InputError for what is the name of none, a file's among it."""
    if path := find(name):
        return path.read_text(encoding="utf-8")
    from abu_calc.spec.names import nearest

    known = names()
    close = nearest(name, known)
    raise InputError(
        "no preset of this name",
        found=name,
        allowed=", ".join(known),
        remedy=f'the nearest is "{close}"' if close else None,
    )


def find(name: str) -> Path | None:
    """The file of a preset, or None where there is none of this name."""
    return folder() / f"{name}{SUFFIX}" if name in names() else None
