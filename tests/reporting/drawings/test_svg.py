"""The SVG file: well formed, true to scale, nothing over anything, and the same drawing as the DXF."""

import re
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import pytest

from abu_calc.features.design.section_drawing import face_drawing, section_drawing
from abu_calc.features.design.sheet import section_sheet, size_sheets
from abu_calc.features.swing_arm.view import SwingArmRecord
from abu_calc.reporting.drawings.dimensions import box, primitives
from abu_calc.reporting.drawings.shapes import Drawing, Length, Line, Radius, Region, Text
from abu_calc.reporting.drawings.svg import svg_figure, svg_file
from tests.cli.runner import abu
from tests.reporting.drawings.overlaps import check_clear
from tests.reporting.drawings.samples import HOSTILE, MACHINES, result

SVG = "{http://www.w3.org/2000/svg}"
ARM = SwingArmRecord(
    advice="nothing to change", changes=(), contact_stiffness_N_per_m=1e6, idle_frequency_rpm=187.0,
    cutting_frequency_rpm=4492.0, joint_damping_N_s_per_m=40.0, damping_limit_bunched_N_s_per_m=None,
    parametric_contact_angles_deg=(), lifted_contact_angles_deg=None, joint_stiffness_standing_N_per_m=1.0,
    pressing_moment_N_m=20.0, least_pressing_moment_N_m=8.6, press_force_N=28.0,
    contact_stiffness_limit_N_per_m=2e6, contact_stiffness_limit_exact_N_per_m=2e6, worst_contact_angle_deg=101.4,
    resonance_rpm=4583.0, damping_limit_N_s_per_m=0.343, parametric_growth_rate_per_s=-1.0, pressed_angle_deg=2.1,
    arm_length=0.35, wheel_diameter=0.23, contact_angle_deg=90.0, touch_angle_deg=2.0,
)  # fmt: skip
ARMS = {
    "usual": {}, "along": {"contact_angle_deg": 180.0}, "none": {"contact_angle_deg": 0.0, "touch_angle_deg": 0.0},
    "back": {"touch_angle_deg": -20.0, "contact_angle_deg": 60.0},
    "wheel longer": {"arm_length": 0.05, "wheel_diameter": 0.3}, "long": {"arm_length": 100.0},
}  # fmt: skip


@cache
def sheet(name: str) -> Drawing:
    """The autobalancer's."""
    return section_sheet(result(name))


@pytest.mark.few(2)
@pytest.mark.parametrize("name", MACHINES)
def test_nothing_overlaps(name: str) -> None:
    check_clear(sheet(name))


@pytest.mark.few(1)
@pytest.mark.parametrize("name", MACHINES)
def test_the_views_stand_apart_from_title_and_notes(name: str) -> None:
    """All that is drawn of the autobalancer lies above the frames and texts of the sheet."""
    drawing = sheet(name)
    views = [box(each, drawing.scale) for each in primitives(
        (one for one in drawing.shapes if isinstance(one, Region | Length | Radius)), drawing.scale)]  # fmt: skip
    written = [box(each, drawing.scale) for each in drawing.shapes if isinstance(each, Line) and each.layer == "frame"]
    margin = 9.9 / drawing.scale  # centring marks stand outside the frame
    written = [(low, high) for low, high in written if low[1] > drawing.low[1] + margin
               and high[1] < drawing.high[1] - margin and low[0] > drawing.low[0] + 2 * margin
               and high[0] < drawing.high[0] - margin]  # fmt: skip
    outer = min(low[1] for low, _ in written)
    block = [high for low, high in written if low[1] > outer or high[1] - low[1] < 1e-9]
    top = max(high[1] for high in block if high[1] < drawing.high[1] - 20 / drawing.scale)
    assert min(low[1] for low, _ in views) > top


@pytest.mark.few(4)
@pytest.mark.parametrize("name", MACHINES)
def test_the_file_is_to_scale(name: str) -> None:
    """Millimetres of the file, the sheet's scale, and the largest circle agree with the outer diameter."""
    root = ElementTree.fromstring(svg_file((sheet(name),)))
    assert root.get("width") == "420mm" and root.get("viewBox") == "0 0 420 297"
    widest = max(float(each.get("r", "0")) for each in root.iter(f"{SVG}circle"))
    assert 2 * widest == pytest.approx(sheet(name).scale * result(name).autobalancer.outer_diameter_mm, abs=1e-3)


@pytest.mark.few(3)
@pytest.mark.parametrize("name", MACHINES)
def test_the_file_says_what_the_drawing_says(name: str) -> None:
    root = ElementTree.fromstring(svg_file((sheet(name),)))
    shown = sorted("".join(each.itertext()) for each in root.iter(f"{SVG}text"))
    assert shown == sorted(each.text for each in primitives(sheet(name).shapes, sheet(name).scale)
                           if isinstance(each, Text))  # fmt: skip
    assert not list(root.iter(f"{SVG}script"))
    assert "href" not in ElementTree.tostring(root, encoding="unicode")


def test_names_are_escaped() -> None:
    text = svg_file((sheet("hostile name"),))
    assert "<script" not in text
    root = ElementTree.fromstring(text)
    title = next(root.iter(f"{SVG}title"))
    assert title.text is not None and " ".join(HOSTILE.split()) in title.text


@pytest.mark.parametrize("nasty", ["\x00\x07\x1b[31m", "\u202ertl", "\ud7ff\ufffe", "\n\t\r", "", " " * 50, "𝔾" * 300])
def test_no_name_breaks_the_file(nasty: str) -> None:
    for drawing in size_sheets(replace(result("one-piece"), title=nasty)):
        ElementTree.fromstring(svg_file((drawing,)).encode("utf-8"))


def test_a_figure_stands_in_a_page() -> None:
    """In the page's colour, as wide as its place, with a text alternative, its ids its own."""
    figures = [svg_figure(make(result("light"), 2.0)) for make in (section_drawing, face_drawing)]
    page = ElementTree.fromstring(f"<p>{''.join(figures)}</p>")
    ids = [each.get("id") for each in page.iter() if each.get("id")]
    assert len(ids) == len(set(ids))
    for figure in page:
        assert figure.get("role") == "img" and figure.get("width") is None
        named = (figure.get("aria-labelledby") or "").split()
        assert len(named) == 2 and set(named) <= set(ids)
        colours = {each.get("stroke") for each in figure.iter()} | {each.get("fill") for each in figure.iter()}
        assert all(one in (None, "none", "currentColor") or one.startswith("url(#") for one in colours)
    described = next(page.iter(f"{SVG}desc")).text or ""
    assert "83 mm" in described or f"{result('light').autobalancer.outer_diameter_mm:g} mm" in described
    for make in (section_drawing, face_drawing):
        check_clear(make(result("light"), 2.0))


@pytest.mark.parametrize("name", MACHINES)
def test_arcs_of_the_race_go_the_right_way(name: str) -> None:
    """The groove's arc in the file bulges away from the axis: the path's middle point, by its radius and flags."""
    one, drawing = result(name), sheet(name)
    if one.autobalancer.groove_radius_mm is None:
        return
    root = ElementTree.fromstring(svg_file((drawing,)))
    kind = "race-ring" if len(one.section.parts) > 2 else "body"
    upper, lower = (each.get("d") or "" for each in root.iter(f"{SVG}path") if each.get("class") == kind)
    for path, sign in ((upper, 1), (lower, -1)):
        arc = re.search(r"([-\d.]+) ([-\d.]+)A([\d.]+) [\d.]+ 0 (\d) (\d) ([-\d.]+) ([-\d.]+)", path)
        assert arc is not None
        x1, y1, radius, large, sweep, x2, y2 = map(float, arc.groups())
        assert radius == pytest.approx(drawing.scale * one.autobalancer.groove_radius_mm, rel=1e-3)
        assert not large and y1 == pytest.approx(y2) and x2 > x1
        # Clockwise on the screen from left to right: up.
        assert sweep == (1 if sign > 0 else 0)


@pytest.mark.few(2)
@pytest.mark.parametrize("name", ARMS)
def test_sketch_of_the_swing_arm(name: str) -> None:
    arm = replace(ARM, **ARMS[name])
    found = size_sheets(replace(result("one-piece"), swing_arm=arm))
    assert [each.name for each in found] == ["section", "body", "cover", "swing-arm"]
    check_clear(found[-1])
    length = next(each for each in found[-1].shapes if isinstance(each, Length))
    assert length.value == arm.arm_length_mm and length.text == f"l = {arm.arm_length_mm:g}"
    ElementTree.fromstring(svg_file(found))


SEATS = {
    "small": ("--designation", "6000"), "usual": ("--designation", "6204"), "thick": ("--designation", "6304"),
    "thin": ("--bore", "400", "--outer", "480", "--width", "40", "--chamfer", "2", "--series", "light"),
    "no chamfer": ("--bore", "17", "--outer", "62", "--width", "17", "--series", "heavy"),
}  # fmt: skip


@pytest.mark.parametrize("name", SEATS)
def test_sketch_of_bearing_seats(name: str, tmp_path: Path) -> None:
    target = tmp_path / "seats.svg"
    seen = abu("check-fit", *SEATS[name], "--radial-load-kN", "1", "--shaft", "k6", "--housing", "H7", "--output",
               str(target))  # fmt: skip
    assert seen.status in (0, 1), seen.err
    texts = ["".join(each.itertext()) for each in ElementTree.parse(target).getroot().iter(f"{SVG}text")]
    assert any(text.endswith(" k6") for text in texts) and any(text.endswith(" H7") for text in texts)


@pytest.mark.slow
def test_drawing_seats_loads_no_numerics(tmp_path: Path) -> None:
    code = (
        "import sys\nfrom abu_calc.cli.app import run\n"
        f"run(['check-fit', 'mmg-3200k-knife-shaft', '-q', '-o', {str(tmp_path / 'x.svg')!r}])\n"
        "sys.exit(bool({'numpy', 'scipy', 'ezdxf'} & sys.modules.keys()))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
    assert (tmp_path / "x.svg").exists()
