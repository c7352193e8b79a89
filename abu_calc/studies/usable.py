"""Early refusal of files that cannot be computed with.

A file that its own commands would refuse, seconds later, is refused at once.
"""

from abu_calc.errors import NotTrustworthyError
from abu_calc.spec.document import Reading
from abu_calc.spec.read import Machine
from abu_calc.spec.read_scene import SceneDescription


def refuse_unusable(source: Reading) -> None:
    """Go the way of the file's commands as far as closed formulas lead, and simulate nothing.

    Raises InputError with file, line and key for what sizing, seats or the scenes of the file would refuse.
    """
    with source.located():
        if isinstance(source, SceneDescription):
            from abu_calc.scenes.durations import lasting
            from abu_calc.scenes.from_scene import scene_from

            lasting(scene_from(source.scene), None, "scene.duration_s")
        if isinstance(source, Machine):
            _machine(source)


def _machine(machine: Machine) -> None:
    if machine.tables.bearing:
        from abu_calc.studies.check_fit import judged_seats

        judged_seats(machine)
    if getattr(machine.tables, "autobalancer", None) is not None:
        _design(machine)


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
