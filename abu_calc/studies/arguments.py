"""Arguments of studies, refused before anything is computed; the key of such an error is the argument's name."""

from collections.abc import Collection, Sequence

from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.errors import InputError, Place
from abu_calc.spec.names import nearest


def one_of(argument: str, value: str | None, allowed: Collection[str]) -> None:
    """Refuse a word that is not allowed; None asks for what is usual."""
    if value is None or value in allowed:
        return
    close = nearest(value, allowed)
    remedy = f'The nearest is "{close}".' if close else None
    raise InputError(
        "not one of the known words", place=Place(key=argument), found=value, allowed=", ".join(allowed), remedy=remedy
    )


def check_effects(present: Sequence[str], with_effects: Sequence[str], without_effects: Sequence[str]) -> None:
    """Refuse effects nobody knows, those there is no data for, and those asked both in and out."""
    known = [name for name, _ in REGISTRY]
    for argument, names in (("with_effects", with_effects), ("without_effects", without_effects)):
        for name in names:
            one_of(argument, name, known)
    for name in with_effects:
        if name not in present:
            raise InputError(
                "the file has no data for this effect",
                place=Place(key="with_effects"),
                found=name,
                allowed=", ".join(present) or "none",
                remedy="Write its table into the file.",
            )
        if name in without_effects:
            raise InputError("an effect cannot be both in and out", place=Place(key="without_effects"), found=name)
