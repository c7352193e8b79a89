"""Reading a scene file, and files that may hold either a scene or a machine."""

from collections.abc import Sequence
from dataclasses import dataclass

from abu_calc.errors import InputError, Place
from abu_calc.spec.document import Document, Reading, open_document, validate
from abu_calc.spec.read import Loaded, machine_from
from abu_calc.spec.scene import SceneFile, SceneTable


@dataclass(frozen=True)
class LoadedScene(Reading):
    """A scene file, read and found right."""

    scene: SceneTable


def read_scene(source: str, overrides: Sequence[str] = ()) -> LoadedScene:
    """Reads a scene file with entries overridden (`scene.key=value`, typed as TOML).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    document = open_document(source)
    if not _holds_scene(document):
        for table, kind in (("machine", "a machine"), ("rig", "readings of a rig")):
            if table in document.content:
                raise InputError(f"this file holds {kind}, not a scene", place=Place(source, key=table))
    return _scene_from(document, overrides)


def read_any(source: str, overrides: Sequence[str] = ()) -> Loaded | LoadedScene:
    """Reads a scene file, or a machine file, or a machine preset by its name: whichever it is."""
    document = open_document(source)
    return _scene_from(document, overrides) if _holds_scene(document) else machine_from(document, overrides)


def _holds_scene(document: Document) -> bool:
    return "scene" in document.content and "machine" not in document.content


def _scene_from(document: Document, overrides: Sequence[str]) -> LoadedScene:
    file, reading = validate(document, overrides, SceneFile, lambda _: SceneFile)
    return LoadedScene(**vars(reading), scene=file.scene)
