"""Frozen dataclasses that share their methods are those of the standard library in all that can be seen."""

import dataclasses
import inspect
import pickle
from copy import copy, deepcopy
from dataclasses import FrozenInstanceError, field
from typing import Any, ClassVar

import pytest

from abu_calc.foundation.frozen import dataclass as shared

STANDARD = dataclasses.dataclass


def classes(dataclass: Any) -> tuple[type, ...]:
    """The same classes by either decorator: defaults, factories, inheritance, fields by name, awkward names."""

    @dataclass(frozen=True)
    class Point:
        x: float
        y: float = 2.0
        names: tuple[str, ...] = ()
        kind: ClassVar[str] = "point"

    @dataclass(frozen=True)
    class Named(Point):
        values: list[int] = field(default_factory=list)
        apart: int = field(default=3, compare=False, repr=False)
        fixed: str = field(default="never given", init=False)
        last: float = field(default=0.0, kw_only=True)

        def __post_init__(self) -> None:
            object.__setattr__(self, "fixed", f"{self.fixed}: {self.x}")

    @dataclass(frozen=True)
    class Empty:
        pass

    @dataclass(frozen=True, eq=False)
    class Itself:
        number: int

    @dataclass(frozen=True)
    class Own:
        number: int

        def __repr__(self) -> str:
            return "own"

        def __eq__(self, other: object) -> bool:
            return True

        def __hash__(self) -> int:
            return 7

    return Point, Named, Empty, Itself, Own


GIVEN: tuple[tuple[int, tuple[Any, ...], dict[str, Any]], ...] = (
    (0, (1.0,), {}),
    (0, (1.0, 5.0), {"names": ("a", "b")}),
    (1, (1.0,), {}),
    (1, (), {"x": 2.0, "values": [1], "apart": 8, "last": 4.0}),
    (2, (), {}),
    (3, (1,), {}),
    (4, (1,), {}),
)

REFUSED: tuple[tuple[int, tuple[Any, ...], dict[str, Any]], ...] = (
    (0, (), {}),
    (0, (1.0, 2.0, (), 4.0), {}),
    (0, (1.0,), {"z": 1.0}),
    (0, (1.0,), {"x": 1.0}),
    (1, (1.0,), {"fixed": "given"}),
    (1, (1.0, 2.0, (), [], 3, 4.0), {}),
)


@pytest.mark.parametrize(("kind", "positional", "named"), GIVEN)
def test_objects_look_and_compare_alike(kind: int, positional: tuple[Any, ...], named: dict[str, Any]) -> None:
    (own, other), (standard, _) = (
        [classes(dataclass)[kind](*positional, **named)] * 2 for dataclass in (shared, STANDARD)
    )
    assert repr(own) == repr(standard)
    assert dataclasses.asdict(own) == dataclasses.asdict(standard)
    assert [each.name for each in dataclasses.fields(own)] == [each.name for each in dataclasses.fields(standard)]
    assert own == other
    assert (own == copy(own)) is (standard == copy(standard))
    assert own != standard or kind == 4


@pytest.mark.parametrize(("kind", "positional", "named"), REFUSED)
def test_arguments_that_the_library_refuses_are_refused(
    kind: int, positional: tuple[Any, ...], named: dict[str, Any]
) -> None:
    for dataclass in (STANDARD, shared):
        with pytest.raises(TypeError):
            classes(dataclass)[kind](*positional, **named)


def test_signatures_are_those_of_the_library() -> None:
    for own, standard in zip(classes(shared), classes(STANDARD), strict=True):
        mine, theirs = inspect.signature(own).parameters, inspect.signature(standard).parameters
        assert [(each.name, each.kind) for each in mine.values()] == [
            (each.name, each.kind) for each in theirs.values()
        ]


def test_what_differs_in_a_compared_field_differs() -> None:
    point, named, _, itself, _ = classes(shared)
    assert point(1.0) == point(1.0) != point(2.0)
    assert named(1.0, apart=1) == named(1.0, apart=2) != named(1.0, last=5.0)
    assert point(1.0) != named(1.0)
    assert itself(1) != itself(1)
    assert len({point(1.0), point(1.0), point(2.0)}) == 2


def test_each_object_has_a_new_value_of_a_factory() -> None:
    named = classes(shared)[1]
    assert named(1.0).values is not named(1.0).values


def test_objects_cannot_be_changed() -> None:
    for kind, positional, named in GIVEN:
        kept = classes(shared)[kind](*positional, **named)
        for change in (lambda kept=kept: setattr(kept, "x", 1), lambda kept=kept: delattr(kept, "x")):
            with pytest.raises(FrozenInstanceError):
                change()


@shared(frozen=True)
class Kept:
    number: float
    more: "Kept | None" = None


def test_objects_travel() -> None:
    kept = Kept(1.5, Kept(2.5))
    assert pickle.loads(pickle.dumps(kept)) == copy(kept) == deepcopy(kept) == dataclasses.replace(kept) == kept
    assert dataclasses.replace(kept, number=3.0) == Kept(3.0, Kept(2.5))


@pytest.mark.parametrize(("first", "second"), ((shared, STANDARD), (STANDARD, shared)))
def test_either_kind_derives_from_the_other(first: Any, second: Any) -> None:
    point = classes(first)[0]

    @second(frozen=True)
    class Further(point):  # type: ignore[misc, valid-type]
        z: float = 4.0

    assert repr(Further(1.0, z=5.0)).endswith("Further(x=1.0, y=2.0, names=(), z=5.0)")
    with pytest.raises(FrozenInstanceError):
        Further(1.0).z = 2.0


def test_nothing_frozen_derives_from_what_can_be_changed() -> None:
    @STANDARD
    class Changed:
        x: float

    with pytest.raises(TypeError, match="frozen"):

        @shared(frozen=True)
        class Further(Changed):
            y: float


def test_what_can_be_changed_is_left_to_the_library() -> None:
    with pytest.raises(TypeError, match="standard library"):
        shared(frozen=False)
