"""The house: imports go one way between layers and features, there are no circles, no folder is too large."""

import re
from collections import Counter

import pytest

from tests.house.structure import PACKAGE, circles, files, imports

LAYERS = (
    "foundation",
    "standards",
    "formulas",
    "inputs",
    "dynamics",
    "sizing",
    "simulation",
    "reporting",
    "registry",
    "cli",
    "features",
)
"""Layers of the package; each imports only those before it."""

FEATURES = (
    "explain",
    "seats",
    "swing_arm",
    "stability",
    "grinding",
    "design",
    "spindle",
    "effects",
    "simulate",
    "levels",
    "declare",
    "balancing",
    "identification",
    "compare",
    "factory",
    "accuracy",
    "sweep",
    "optimise",
    "verify",
    "files",
)
"""Features in order; each may use those before it."""

TOP = ("abu_calc", "abu_calc.__main__", "abu_calc.units", "abu_calc.version", "abu_calc.cli.app", "abu_calc.cli.start")
"""The public face, and where the command begins: they know the registry, and import features by its names."""

DYNAMICS = ("supports", "equations", "switching", "effects", "codegen", "integrators", "averaging", "stability")
"""The packages inside `dynamics`, behind its own files."""


def layer(name: str) -> int:
    """The place of a file's layer, and of a feature behind all layers."""
    parts = name.split(".")
    if len(parts) > 2 and parts[1] == "features":
        return len(LAYERS) + FEATURES.index(parts[2])
    return LAYERS.index(parts[1]) if len(parts) > 1 and parts[1] in LAYERS else -1


def _inner(name: str) -> int:
    """The place of a file of `dynamics`; its own files come first."""
    parts = name.split(".")
    return DYNAMICS.index(parts[2]) if len(parts) > 2 and parts[2] in DYNAMICS else -1


def test_every_folder_has_a_place() -> None:
    folders = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert folders == set(LAYERS) - {"registry"}
    assert {path.parent.name for path in PACKAGE.glob("features/*/__init__.py")} == set(FEATURES)
    assert {path.parent.name for path in PACKAGE.glob("dynamics/*/__init__.py")} == set(DYNAMICS)


def test_a_file_imports_only_layers_and_features_before_its_own() -> None:
    assert len(files()) > 400
    above = {name: {other for other in imports()[name] if layer(other) > layer(name)} for name in files()}
    assert {name: others for name, others in above.items() if others and name not in TOP} == {}


def test_only_the_start_of_the_command_imports_the_application() -> None:
    asking = {name for name in imports() if {"abu_calc.cli.app", "abu_calc.cli.start"} & imports()[name]}
    assert asking <= set(TOP)


@pytest.mark.parametrize("room", ["", *DYNAMICS])
def test_packages_of_dynamics_have_their_order(room: str) -> None:
    for name in imports():
        if name.startswith("abu_calc.dynamics") and _inner(name) == (DYNAMICS.index(room) if room else -1):
            others = {other for other in imports()[name] if other.startswith("abu_calc.dynamics")}
            above = {other for other in others if _inner(other) > _inner(name)}
            assert not above, f"{name} imports {above}"


def test_files_import_each_other_in_no_circle() -> None:
    assert [circle for circle in circles() if len(circle) > 1] == []


def test_no_folder_holds_too_many_files() -> None:
    sizes = Counter(str(path.parent.relative_to(PACKAGE)) for path in files().values())
    folder, most = sizes.most_common(1)[0]
    assert most <= 26, (folder, most)


def test_kinds_of_support_are_asked_for_in_few_places() -> None:
    """A support answers for itself; scenes make them, nobody else asks which kind one is."""
    asks = re.compile(r"isinstance\([^)]*\b(SwingArmSupport|LinearSupport)\b|\.tilts\b|arm_length is (not )?None")
    asking = [
        name for name, path in files().items()
        if ".supports." not in name and asks.search(path.read_text(encoding="utf-8"))
    ]  # fmt: skip
    assert len(asking) <= 3, asking
