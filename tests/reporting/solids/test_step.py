"""STEP files as an independent kernel reads them: valid, as large as designed, nothing in the way of anything else."""

import re
from itertools import combinations
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from abu_calc.features.design.sheet import size_solids
from abu_calc.reporting.solids.assembly import PlacedSolid, RevolvedSolid, SolidAssembly, ball_profile
from abu_calc.reporting.solids.step import step_text
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
