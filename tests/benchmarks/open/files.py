"""Cases and reference motions as files: parameters in SI, times, states."""

import json
from pathlib import Path
from typing import Any, Final

FOLDER: Final = Path(__file__).parent / "cases"


def names() -> tuple[str, ...]:
    """Names of all cases."""
    return tuple(sorted(path.stem for path in FOLDER.glob("*.json") if ".reference" not in path.name))


def case_path(name: str) -> Path:
    """File of a case."""
    return FOLDER / f"{name}.json"


def case_of(path: Path) -> dict[str, Any]:
    """Case of a file."""
    document: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return document


def reference_path(name: str) -> Path:
    """File of a reference motion."""
    return FOLDER / f"{name}.reference.json"


def reference_of(name: str) -> dict[str, Any]:
    """Reference motion of a case."""
    document: dict[str, Any] = json.loads(reference_path(name).read_text(encoding="utf-8"))
    return document


def switches(case: dict[str, Any]) -> bool:
    """True if balls meet or rub in a case."""
    return "restitution" in case or bool(case.get("rolling_friction"))
