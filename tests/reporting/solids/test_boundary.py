"""Boundaries of solids of revolution: closed, oriented, each face on the surface that its edge sweeps."""

import re
from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings

from abu_calc.reporting.solids.assembly import RevolvedSolid, ball_profile
from abu_calc.reporting.solids.step import EntityFile, solid_entity
from tests.reporting.solids.profiles import turned_solids


def written(part: RevolvedSolid) -> list[str]:
    file = EntityFile()
    solid_entity(file, part)
    return list(file.lines())


def surfaces(part: RevolvedSolid) -> Counter[str]:
    """Kinds of surface under the faces."""
    lines = dict(re.fullmatch(r"(#\d+)=(.*);", line).groups() for line in written(part))  # type: ignore[union-attr]
    faces = [text for text in lines.values() if text.startswith("ADVANCED_FACE")]
    under = (lines[re.search(r"\),(#\d+),\.[TF]\.\)$", face)[1]] for face in faces)  # type: ignore[index]
    return Counter(text.partition("(")[0] for text in under)


@settings(deadline=None)
@given(turned_solids())
@pytest.mark.slow
def test_each_edge_is_used_twice_in_opposite_senses(part: RevolvedSolid) -> None:
    """So the shell is closed and oriented; with its vertices and faces it is a sphere, or a torus with a bore."""
    lines = written(part)
    oriented = re.compile(r"ORIENTED_EDGE\('',\*,\*,(#\d+),(\.[TF]\.)")
    uses = Counter(match.groups() for line in lines if (match := oriented.search(line)))
    edges = [line.partition("=")[0] for line in lines if "=EDGE_CURVE(" in line]
    assert set(uses.values()) == {1} and set(uses) == {(edge, sense) for edge in edges for sense in (".T.", ".F.")}
    vertices = sum("=VERTEX_POINT(" in line for line in lines)
    faces, loops = sum("=ADVANCED_FACE(" in line for line in lines), sum("=EDGE_LOOP(" in line for line in lines)
    holes = 0 if any(r == 0 for _, r, _ in part.profile) else 1
    assert vertices - len(edges) + faces - (loops - faces) == 2 * (1 - holes)


@pytest.mark.parametrize(
    ("profile", "kinds"),
    [
        (ball_profile(8.0), {"SPHERICAL_SURFACE": 2}),
        (((0, 2, 0), (5, 2, 0), (5, 4, 0), (0, 4, 0)), {"CYLINDRICAL_SURFACE": 4, "PLANE": 2}),
        (((0, 0, 0), (6, 0, 0), (0, 4, 0)), {"CONICAL_SURFACE": 2, "PLANE": 1}),
        (((-1, 5, 1.0), (1, 5, 1.0)), {"TOROIDAL_SURFACE": 4}),
        # A groove in a ring whose radius is larger than the distance of its centre from the axis.
        (((0, 11, -0.1), (4, 11, 0), (4, 14, 0), (0, 14, 0)), {"DEGENERATE_TOROIDAL_SURFACE": 2, "PLANE": 2,
                                                           "CYLINDRICAL_SURFACE": 2}),
    ],
)  # fmt: skip
def test_edges_sweep_their_surfaces(profile: tuple[tuple[float, float, float], ...], kinds: dict[str, int]) -> None:
    assert surfaces(RevolvedSolid("part", profile, "steel", 7800.0)) == kinds


def test_an_arc_about_a_centre_below_the_axis_is_refused() -> None:
    lens = RevolvedSolid("lens", ((0, 2, 0), (8, 2, 0.1)), "steel", 7800.0)
    with pytest.raises(ValueError, match="lens: an arc has its centre below the axis"):
        written(lens)


@pytest.mark.parametrize("profile", [
    ((0, 11, -0.1), (4, 11, 0), (4, 14, 0), (0, 14, 0)), ((-1, 5, 0.6), (1, 6, 0.9)), ((-1, 5, 1.0), (1, 5, 1.0)),
    ball_profile(8.0),
])  # fmt: skip
def test_arcs_of_the_profile_count_their_angle_from_where_they_start(
    profile: tuple[tuple[float, float, float], ...],
) -> None:
    """A circle's angle is 0 in its reference direction; both ends lie on the circle."""
    lines = dict(line.rstrip(";").split("=", 1) for line in written(RevolvedSolid("part", profile, "steel", 7800.0)))

    def parts(number: str) -> tuple[str, list[str]]:
        keyword, _, rest = lines[number].partition("(")
        return keyword, re.findall(r"#\d+", rest)

    def numbers(number: str) -> np.ndarray:
        return np.array([float(each) for each in re.findall(r"-?[\d.]+(?:E-?\d+)?", lines[number].partition("(")[2])])

    meridians = 0
    for number in lines:
        keyword, refers = parts(number)
        if keyword != "EDGE_CURVE" or parts(refers[2])[0] != "CIRCLE":
            continue
        start, end = (numbers(parts(each)[1][0]) for each in refers[:2])
        centre, axis, across = (numbers(each) for each in parts(parts(refers[2])[1][0])[1])
        radius = float(lines[refers[2]].rpartition(",")[2].rstrip(")"))
        for place in (start, end):
            assert np.linalg.norm(place - centre) == pytest.approx(radius)
            assert (place - centre) @ axis == pytest.approx(0.0, abs=1e-9)
        if axis[1]:  # across the axis of the solid: an arc of the profile
            meridians += 1
            assert start == pytest.approx(centre + radius * across, abs=1e-9)
    assert meridians == 2 * sum(bool(bulge) for *_, bulge in profile)
