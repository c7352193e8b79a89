"""Whether a file can be computed with: what its own commands would refuse, seconds later, is refused at once."""

from abu_calc.errors import NotTrustworthyError
from abu_calc.spec.read import Machine
from abu_calc.spec.read_scene import SceneDescription


def refuse_unusable(source: Machine | SceneDescription) -> None:
    """Go the way of the file's commands as far as closed formulas lead, and simulate nothing.

    Raises InputError with file, line and key for what sizing, seats or the scenes of the file would refuse.
    """
    if isinstance(source, SceneDescription):
        _scene(source)
        return
    with source.located():
        if source.tables.bearing:
            from abu_calc.studies.check_fit import judged_seats

            judged_seats(source)
        if getattr(source.tables, "autobalancer", None) is not None:
            _design(source)


def _design(machine: Machine) -> None:
    from abu_calc.analysis.machine import scenes_of
    from abu_calc.scenes.from_design import scene_of_design
    from abu_calc.sizing import size

    design = size(machine.whole("size"))
    for name in scenes_of(design):
        try:
            scene_of_design(design, name)
        except NotTrustworthyError:  # for `abu size` to tell: the file may be right
            continue


def _scene(description: SceneDescription) -> None:
    from abu_calc.scenes.from_scene import lasting, scene_from

    with description.located():
        lasting(scene_from(description.scene), None, "scene.duration_s")
