"""Reading a scene file, and files that may hold either a scene or a machine."""

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from abu_calc.frozen import dataclass
from abu_calc.spec.document import Document, Reading, named, open_document, parsed_overrides, validate
from abu_calc.spec.kinds import kind_of, refuse_others
from abu_calc.spec.read import Machine, machine_from
from abu_calc.spec.scene import SceneFile, SceneTable

if TYPE_CHECKING:
    from abu_calc.spec.overrides import Override
    from abu_calc.spec.sweep import Sweep


@dataclass(frozen=True)
class SceneDescription(Reading):
    """A scene file; `scene` is what stands in it, in the units people wrote."""

    scene: SceneTable
    sweep: "Sweep | None" = None

    def changed(self, values: Mapping[str, object]) -> "SceneDescription":
        """The scene with entries of its file replaced, by key path: `changed({"scene.speed_rpm": 5800.0})`.

        Checked as if the file said so; raises InputError with key, what was found, and what is allowed.
        """
        from abu_calc.spec.overrides import following, overrides_of

        return scene_from(self.document, following(self.overrides, overrides_of(values), SceneFile))


def read_scene(source: str | os.PathLike[str], overrides: Sequence[str] = ()) -> SceneDescription:
    """Reads a scene file with entries overridden (`scene.key=value`, typed as TOML).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    return scene_from(open_document(named(source)), parsed_overrides(overrides))


def read_any(source: str, overrides: Sequence[str] = ()) -> Machine | SceneDescription:
    """Reads a scene file, or a machine file, or a machine preset by its name: whichever it is."""
    document, replaced = open_document(source), parsed_overrides(overrides)
    if kind_of(document.content).name == "scene":
        return scene_from(document, replaced)
    return machine_from(document, replaced)


def scene_from(document: Document, overrides: "Sequence[Override]" = ()) -> SceneDescription:
    """The scene of a document that is open already; raises as `read_scene` does."""
    refuse_others(document, "scene")
    file, reading = validate(document, overrides, SceneFile, lambda _: SceneFile)
    return SceneDescription(**vars(reading), scene=file.scene, sweep=file.sweep)
