"""STEP files as an independent kernel reads them: valid, as large as designed, nothing in the way of anything else.

Values of an exchange file as ISO 10303-21 spells them.

Boundaries of solids of revolution: closed, oriented, each face on the surface that its edge sweeps.
"""

import re
from collections import Counter
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from abu_calc.features.design.sheet import size_solids
from abu_calc.reporting.solids.assembly import PlacedSolid, RevolvedSolid, SolidAssembly, ball_profile
from abu_calc.reporting.solids.step import EntityFile, solid_entity, spelled, step_text, written_string
from tests.reporting.drawings.samples import MACHINES, result
from tests.reporting.solids.profiles import turned_solids

BALL = RevolvedSolid("ball", ball_profile(8.0), "steel", 7800.0)
PAIR = SolidAssembly("pair", "d'Ø", (PlacedSolid("left", BALL), PlacedSolid("right", BALL, (20.0, 0.0, 0.0))))


def test_a_solid_that_is_used_twice_is_written_once() -> None:
    text = step_text(PAIR)
    assert text.count("MANIFOLD_SOLID_BREP(") == 1 and text.count("NEXT_ASSEMBLY_USAGE_OCCURRENCE(") == 2
    assert text.startswith("ISO-10303-21;\nHEADER;\n") and text.endswith("END-ISO-10303-21;\n") and text.isascii()
    assert "FILE_DESCRIPTION(('d\\X\\27\\X2\\00D8\\X0\\'),'2;1');" in text
    assert "SI_UNIT(.MILLI.,.METRE.)" in text


def test_every_reference_is_there_and_every_entity_but_the_outermost_is_used() -> None:
    lines = re.findall(r"^#(\d+)=(.*);$", step_text(PAIR), re.M)
    numbers = [int(number) for number, _ in lines]
    assert numbers == list(range(1, len(lines) + 1))
    for number, body in lines:
        assert all(int(other) < int(number) for other in re.findall(r"#(\d+)", body))


def test_equal_runs_give_equal_files(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    text = step_text(PAIR)
    assert text == step_text(PAIR) and "'1970-01-01T00:00:00'" in text
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert "'2023-11-14T22:13:20'" in step_text(PAIR)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    assert step_text(PAIR) == text


@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_the_kernel_finds_the_design(name: str, tmp_path: Path) -> None:
    """Names, validity, volume and mass to 1e-9; no two items share space, and the balls touch their race."""
    from tests.reporting.solids.kernel import common_volume, distance, read_step

    sized = result(name)
    assembly = size_solids(sized)
    file = tmp_path / "design.step"
    file.write_text(step_text(assembly), encoding="ascii")
    read = read_step(file)
    assert read.name == assembly.name
    assert [(item.name, item.part) for item in read.items] == [(each.name, each.solid.name) for each in assembly.items]
    masses = {part.name: part.mass_g for part in sized.section.parts}
    balls = {sized.autobalancer.corrector: sized.autobalancer.ball_mass_g}
    total = 0.0
    for found, wanted in zip(read.items, assembly.items, strict=True):
        assert found.valid, found.name
        assert found.volume == pytest.approx(wanted.solid.volume_mm3, rel=1e-9)
        mass = found.volume * wanted.solid.density * 1e-6
        assert mass == pytest.approx((masses | balls)[found.part], rel=1e-6)
        assert found.centre[:2] == pytest.approx(wanted.shift[:2], abs=1e-6)
        total += mass
    assert total == pytest.approx(sized.autobalancer.mass_g, rel=1e-6)
    for first, second in combinations(read.items[: 3 + len(sized.section.parts)], 2):
        assert distance(first, second) >= 0.0
        assert common_volume(first, second) == pytest.approx(0.0, abs=1e-6), (first.name, second.name)
    race = next(item for item in read.items if item.part == ("race ring" if "race ring" in masses else "body"))
    for item in read.items:
        if item.part in balls:
            assert distance(item, race) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.slow
@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(turned_solids())
def test_the_kernel_finds_random_parts(tmp_path: Path, part: RevolvedSolid) -> None:
    from tests.reporting.solids.kernel import read_step

    file = tmp_path / "part.step"
    file.write_text(step_text(SolidAssembly("one", "one", (PlacedSolid("part", part),))), encoding="ascii")
    (found,) = read_step(file).items
    assert found.valid and found.volume == pytest.approx(part.volume_mm3, rel=1e-6)


def test_each_part_is_tied_to_its_material_and_density() -> None:
    """Programs find a property from its definition, which holds the part, over the link to what it says."""
    bush = RevolvedSolid("bush", ((0, 2, 0), (5, 2, 0), (5, 4, 0), (0, 4, 0)), "aluminium alloy", 2700.0)
    items = (*PAIR.items, PlacedSolid("bush", bush, (40.0, 0.0, 0.0)))
    text = step_text(SolidAssembly("three", "three", items))
    entities: dict[str, str] = dict(re.findall(r"^#(\d+)=(.*);$", text, re.M))

    def follow(number: str, *keywords: str) -> str:
        """The entity that one refers to over others, each by its keyword."""
        for keyword in keywords:
            (number,) = (n for n in re.findall(r"#(\d+)", entities[number]) if entities[n].startswith(f"{keyword}("))
        return entities[number]

    said = dict[str, list[str]]()
    for number, body in entities.items():
        if body.startswith("PROPERTY_DEFINITION_REPRESENTATION("):
            way = "PROPERTY_DEFINITION", "PRODUCT_DEFINITION", "PRODUCT_DEFINITION_FORMATION", "PRODUCT"
            name = follow(number, *way).split("'")[1]
            in_words = "'material name'" in follow(number, "PROPERTY_DEFINITION")
            item = "DESCRIPTIVE_REPRESENTATION_ITEM" if in_words else "MEASURE_REPRESENTATION_ITEM"
            said.setdefault(name, []).append(follow(number, "REPRESENTATION", item))
    assert set(said) == {"ball", "bush"}
    for solid, (material, density) in ((BALL, said["ball"]), (bush, said["bush"])):
        assert f"'{solid.material}'" in material
        assert f"({solid.density:.0f}.)" in density


@pytest.mark.parametrize(
    ("value", "text"),
    [(1.0, "1."), (-0.0, "0."), (1e-7, "1.E-07"), (1.5e22, "1.5E+22"), (3, "3"), (True, ".T."), (None, "$"),
     ("it's \\", "'it\\X\\27s \\\\'"), ((1.0, (2.5,)), "(1.,(2.5))"), ("шар", "'\\X2\\044804300440\\X0\\'"),
     ("𝄞", "'\\X4\\0001D11E\\X0\\'")],
)  # fmt: skip
def test_values_are_spelled(value: object, text: str) -> None:
    assert spelled(value) == text


@pytest.mark.slow
@given(st.text())
def test_strings_hold_ascii_alone_and_read_back(text: str) -> None:
    """No apostrophe stands in a string: readers such as OpenCASCADE take one before ")" for the string's end."""
    written = written_string(text)
    assert (written.isascii() and written.isprintable()) or written == ""
    plain = {"\\\\": "\\", "\\X\\27": "'"}
    back = re.sub(r"\\\\|\\X\\27|\\X([24])\\([0-9A-F]+)\\X0\\", lambda match: plain.get(match[0]) or "".join(
        chr(int(match[2][k : k + 2 * int(match[1])], 16)) for k in range(0, len(match[2]), 2 * int(match[1]))
    ), written)  # fmt: skip
    shown = "".join(sign if sign.isprintable() else " " for sign in text)
    assert back == shown and "'" not in written


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_read_back_whole(value: float) -> None:
    assert float(spelled(value)) == value and re.fullmatch(r"-?\d+\.\d*(E[+-]\d+)?", spelled(value))


def test_what_is_no_value_is_refused() -> None:
    with pytest.raises(ValueError, match="finite"):
        spelled(float("nan"))
    with pytest.raises(TypeError):
        spelled({1})


def test_equal_values_are_one_entity_and_things_are_not() -> None:
    file = EntityFile()
    assert file.add("DIRECTION", "", (0.0, 0.0, 1.0)) == file.add("DIRECTION", "", (0.0, 0.0, 1.0))
    assert file.own("PRODUCT", "a") != file.own("PRODUCT", "a")
    assert next(iter(file.lines())) == "#1=DIRECTION('',(0.,0.,1.));"


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
