"""The DXF file as a CAD program reads it: sound, closed, every dimension the result's, parts as heavy as the design."""

import importlib.util
import io
import math
import re
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING

import pytest

from abu_calc.features.design.sheet import section_sheet, size_sheets
from abu_calc.features.design.study import SizeResult
from tests.cli.runner import abu
from tests.reporting.drawings.samples import MACHINES, result

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

ezdxf = pytest.importorskip("ezdxf")
DENSITY = {"steel": 7.8e-3, "aluminium": 2.7e-3}


@cache
def document(name: str) -> "Document":
    """Read back."""
    from abu_calc.reporting.drawings.dxf import dxf_text

    return ezdxf.read(io.StringIO(dxf_text(section_sheet(result(name)))))


def _expected(one: SizeResult) -> dict[str, float]:
    """What the drawing must dimension: the text's beginning, and the number in the JSON."""
    made, section = one.to_dict()["autobalancer"], one.to_dict()["section"]
    sizes = {
        "outer": made["outer_diameter_mm"], "bore": section["bore_diameter_mm"], "width": made["width_mm"],
        "inner": section["inner_width_mm"], "web": section["web_mm"], "cover": section["web_mm"],
        "race": 2 * made["race_radius_mm"], "pitch": 2 * made["pitch_radius_mm"], "hub": section["hub_diameter_mm"],
    }  # fmt: skip
    if len(section["parts"]) > 2:
        sizes["ring"] = section["ring_diameter_mm"]
    return sizes


@pytest.mark.few(0, 5)
@pytest.mark.parametrize("name", MACHINES)
def test_cad_finds_nothing_to_mend(name: str) -> None:
    audit = document(name).audit()
    assert not audit.errors and not audit.fixes
    assert document(name).units == ezdxf.units.MM


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.slow
def test_every_dimension_is_the_result_s(name: str) -> None:
    """Measured on the geometry, and as written to the digits shown; none is missing, none is beside."""
    wanted = sorted(_expected(result(name)).values())
    found = list(document(name).modelspace().query("DIMENSION"))
    assert sorted(each.get_measurement() for each in found) == pytest.approx(wanted, rel=1e-9)
    for each in found:
        text = re.search(r"\d+(?:\.\d+)?", each.dxf.text)
        assert text is not None
        digits = len(text[0].partition(".")[2])
        assert abs(float(text[0]) - each.get_measurement()) <= 0.5 * 10**-digits + 1e-9, each.dxf.text
        shown = " ".join(one.dxf.text for one in each.get_geometry_block().query("TEXT"))
        assert shown == each.dxf.text.replace("\\X", " ")


@pytest.mark.few(1)
@pytest.mark.parametrize("name", MACHINES)
def test_tolerances_are_the_result_s(name: str) -> None:
    """On the sheet of the part that has the race, and the bore's on the assembly's, too."""
    from abu_calc.reporting.drawings.dxf import dxf_text

    one = result(name).to_dict()
    section, race = one["section"], result(name).parts.race_part.name.replace(" ", "-")
    sheet = next(each for each in size_sheets(result(name)) if each.name == race)
    space = ezdxf.read(io.StringIO(dxf_text(sheet))).modelspace()
    texts = [each.dxf.text for each in (*space.query("DIMENSION"), *space.query("TEXT"))]
    if name == "bearing-ring":  # its ring is bought: a sphere without a tolerance of ours
        assert any(text.startswith("race SØ") for text in texts)
        return
    race_text = f"race Ø{2 * one['autobalancer']['race_radius_mm']:.2f} ±0.10"
    assert any(text.startswith(race_text) for text in texts)
    assert section["race_tolerance_mm"] == 0.05 and section["groove_tolerance_mm"] == 0.2
    assert any(text.endswith("±0.20") for text in texts) == (one["autobalancer"]["groove_radius_mm"] is not None)
    if section["bore_limits_um"] is not None:
        every = " ".join(each.dxf.text for each in document(name).modelspace().query("DIMENSION TEXT"))
        low, high = section["bore_limits_um"]
        assert f"(+{high / 1000:g} / {low:g})" in every and section["bore_class"] in every
    frames = [each.dxf.content for each in space.query("TOLERANCE")]
    assert f"{{\\Fgdt;e}}%%v{section['circularity_um'] / 1000:g}" in frames


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.slow
def test_outlines_are_closed_and_weigh_what_the_design_weighs(name: str) -> None:
    """Each part twice, above and below the axis: area within 0.5 %, mass of half a turn of each within 0.5 %."""
    one = result(name).to_dict()
    outlines = document(name).modelspace().query('LWPOLYLINE[layer=="OUTLINE"]')
    assert all(each.closed for each in outlines)
    parts = [part for part in one["section"]["parts"] for _ in range(2)]
    assert len(outlines) == len(parts) == len(document(name).modelspace().query("HATCH"))
    total = one["autobalancer"]["ball_count"] * one["autobalancer"]["ball_mass_g"]
    for outline, part in zip(outlines, parts, strict=True):
        area, moment = _area_and_moment(outline)
        assert area == pytest.approx(part["section_area_mm2"], rel=0.005)
        mass = DENSITY[part["material"]] * math.pi * moment
        assert mass == pytest.approx(part["mass_g"] / 2, rel=0.005)
        total += mass
    assert total == pytest.approx(one["autobalancer"]["mass_g"], rel=0.005)


def _area_and_moment(outline: "ezdxf.entities.LWPolyline") -> tuple[float, float]:
    """Of what CAD makes of it, in chords: area, and ∫|y| dA."""
    from ezdxf.path import make_path

    points = [(point.x, point.y) for point in make_path(outline).flattening(0.001)]
    assert math.dist(points[0], points[-1]) < 1e-9
    cross = [(a[0] * b[1] - b[0] * a[1], a[1] + b[1]) for a, b in pairwise(points)]
    return abs(sum(each for each, _ in cross)) / 2, abs(sum(each * y for each, y in cross)) / 6


@pytest.mark.slow
def test_layers_are_kinds_of_line() -> None:
    drawn = document("light")
    used = {entity.dxf.layer for entity in drawn.modelspace()}
    assert used == {"OUTLINE", "HIDDEN", "CENTRE", "HATCH", "DIMENSION", "TEXT", "FRAME"}
    layers = {name: drawn.layers.get(name) for name in used}
    assert layers["OUTLINE"].dxf.lineweight > layers["DIMENSION"].dxf.lineweight > layers["HATCH"].dxf.lineweight
    assert layers["CENTRE"].dxf.linetype != layers["HIDDEN"].dxf.linetype != "CONTINUOUS"


@pytest.mark.few(2)
@pytest.mark.parametrize("name", MACHINES)
def test_the_title_block_says_where_it_is_from(name: str) -> None:
    one = result(name)
    texts = [each.dxf.text for each in document(name).modelspace().query("TEXT")]
    assert one.provenance.sha256 in texts
    assert one.provenance.date in texts
    assert "avtovaz-707-222" in texts
    mass = next(text for text in texts if text.endswith(" g") and text[0].isdigit())
    assert float(mass[:-2]) == pytest.approx(one.autobalancer.mass_g, abs=0.0501)
    for part in one.section.parts:
        assert f"{part.mass_g:.2f}".rstrip("0").rstrip(".") in texts


@pytest.mark.slow
def test_names_stand_as_they_are() -> None:
    """%%c, ^J and \\U+ are escapes of DXF; ezdxf undoes them as CAD programs do."""
    from abu_calc.reporting.drawings.dxf import written

    drawn = ezdxf.new("R2010").modelspace().add_text(written("50%%c 100 % ^J A^B"))
    assert drawn.plain_text() == "50%%c 100 % ^J A^B"
    texts = [each.plain_text() for each in document("hostile name").modelspace().query("TEXT")]
    assert any(text.startswith('<script>alert("1")</script> & Schleifer ÄÖÜß ]]>') for text in texts)


def test_without_the_extra_what_is_missing_is_named_before_anything_is_computed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: "pytest.TempPathFactory"
) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "ezdxf" else found(name))
    target = tmp_path / "section.dxf"  # type: ignore[operator]
    seen = abu("size", "avtovaz-707-222", "--output", str(target))
    assert seen.status == 2
    assert "ezdxf" in seen.err and 'pip install "abu-calc[report]"' in seen.err
    assert not target.exists()


@pytest.mark.parametrize("command", [("simulate", "avtovaz-707-222"), ("check-fit", "mmg-3200k-knife-shaft")])
def test_other_commands_have_no_dxf(command: tuple[str, ...], tmp_path: "pytest.TempPathFactory") -> None:
    seen = abu(*command, "--output", str(tmp_path / "x.dxf"))  # type: ignore[operator]
    assert seen.status == 2
    assert "unknown format" in seen.err and ".json" in seen.err
