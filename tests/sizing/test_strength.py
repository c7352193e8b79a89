"""What is judged where it is worst: over the speed range, at friction's worst arrangement, with an oval race."""

import math

import numpy as np
import pytest

from abu_calc.sizing import size
from abu_calc.sizing.balls import candidates, evaluate
from abu_calc.sizing.case import Case, read_case
from abu_calc.sizing.design import Design
from abu_calc.sizing.strength import (
    STEEL_MODULUS,
    STEEL_POISSON,
    hinged_wall_lobes,
    ring_flexure,
    wall_lobes,
    web_lobes,
)
from tests.sizing.machines import DRUM, check_of, machine

FORCE, RADIUS, WIDTH, WALL = 139.0, 31e-3, 16.5e-3, 2.5e-3


def test_a_web_bears_two_lobes_as_elasticity_says() -> None:
    """σ_r = −(2A + 6C/r⁴ + 4D/r²), τ = 2A + 6Br² − 6C/r⁴ − 2D/r², times cos 2θ and sin 2θ: four conditions solved,
    then u_r by integrating the strain ε_r = (σ_r − νσ_θ)/E.
    """
    inner, thickness, nu = 14e-3, 1.5e-3, STEEL_POISSON

    def radial(r: float) -> list[float]:
        return [-2.0, 0.0, -6 / r**4, -4 / r**2]

    def shear(r: float) -> list[float]:
        return [2.0, 6 * r**2, -6 / r**4, -2 / r**2]

    pulled = 2 * FORCE / (math.pi * RADIUS * thickness)
    a, b, c, d = np.linalg.solve(
        [radial(RADIUS), shear(RADIUS), radial(inner), shear(inner)], [pulled, 0.0, 0.0, 0.0]
    ).tolist()
    r = RADIUS
    strained = 2 * a * (1 + nu) * r + 4 * nu * b * r**3 - 2 * c * (1 + nu) / r**3 - 4 * d / r
    found = web_lobes(FORCE, RADIUS, inner, thickness, STEEL_MODULUS)
    assert found == pytest.approx(-strained / STEEL_MODULUS, rel=1e-9)


def test_a_narrow_web_is_the_thin_ring() -> None:
    """Of the 0.149 of the diameter, 4/(9π)/0.149 are the amplitude of two lobes."""
    thin, mean = 0.2e-3, RADIUS - 0.1e-3
    web = web_lobes(FORCE, RADIUS, RADIUS - thin, 5e-3, STEEL_MODULUS)
    ring = ring_flexure(FORCE, mean, 5e-3, thin)
    assert web / ring == pytest.approx(2 / (9 * math.pi) / 0.149, rel=0.02)


def test_a_hinged_wall_gives_by_its_energy() -> None:
    """½πR·D·B²∫[(3x/R²)² + 2(1−ν)(3/(2R))²]dx for w = Bx·cos 2θ against the work of the load at l/2, by quadrature."""
    rigidity = STEEL_MODULUS * WALL**3 / (12 * (1 - STEEL_POISSON**2))
    x = (np.arange(1000) + 0.5) * WIDTH / 1000
    density = (3 * x / RADIUS**2) ** 2 + 2 * (1 - STEEL_POISSON) * (3 / (2 * RADIUS)) ** 2
    stiffness = rigidity * density.sum() * WIDTH / 1000
    slope = 2 * FORCE / (math.pi * RADIUS) * (WIDTH / 2) / stiffness
    assert hinged_wall_lobes(FORCE, RADIUS, WIDTH, WALL) == pytest.approx(slope * WIDTH / 2, rel=1e-5)
    assert wall_lobes(FORCE, RADIUS, WIDTH, WALL) < hinged_wall_lobes(FORCE, RADIUS, WIDTH, WALL)


def test_a_thin_drum_does_not_pass() -> None:
    """The design "light", eight balls, a drum of half a metre: a free ring would go oval by some 70 mm."""
    design = size(machine(**DRUM))
    assert design.autobalancer.roundness.free_ring == pytest.approx(69e-3, rel=0.01)
    assert [check.code for check in design.checks if check.status == "fail"] == ["ABU304", "ABU307"]
    thicker = evaluate(_thicker(design, 5.0), design.imbalance.value, 8, 24e-3, 0.25)
    assert thicker.stays_round


def _thicker(design: Design, wall: float) -> Case:
    table = design.case.table
    assert table.autobalancer is not None
    changed = table.autobalancer.model_copy(update={"min_wall_mm": wall})
    return read_case(table.model_copy(update={"autobalancer": changed}))


@pytest.mark.slow
def test_the_search_avoids_races_that_go_oval() -> None:
    """At 11 000 rpm fewer and larger balls on a smaller race would be lighter, and good for everything else."""
    design = size(machine(machine__speed_rpm=11000, wheel__imbalance_g_mm=400.0))
    chosen = design.autobalancer
    lighter = [
        one
        for one in candidates(design.case, design.imbalance.value)
        if one.mass < chosen.mass and one.capacity_ratio >= 1.2 and one.strength.enough and one.budget.within
    ]
    assert lighter and not any(one.stays_round for one in lighter)
    assert check_of(design, "ABU304").status == "pass"
