"""Steady contact of a tilting rotor, against equations of four real freedoms written out here, and the point mass."""

import cmath
import math

import numpy as np
import pytest

from abu_calc.formulas.tilting_contact import SteadyContact, TiltingContact
from abu_calc.formulas.tilting_rotor import Bearing, PlacedImbalance, TiltingRotor, balancing_resultants

SPEED = 2850 * 2 * math.pi / 60
ROTOR = TiltingRotor(62.0, 3.1, 0.09, (Bearing(0.2, 2.2e5, 300.0), Bearing(-0.2, 2.2e5, 300.0)))
WHEELS = [PlacedImbalance(0.26, 2500e-6 + 0j), PlacedImbalance(-0.26, 1800e-6 * cmath.exp(1j))]
RACES = (0.3, -0.3)
CONTACTS = [(5e-6, -0.35), (5e-7, -0.35), (0.0, -0.35), (2e-6, 0.2), (0.0, 0.0)]


def phasors(place: float, compliance: float, friction: float, runout: complex, loads: list[PlacedImbalance]):  # type: ignore[no-untyped-def]
    """x, y, α, β and N as phasors of e^{iΩt}: r = x + iy, tilt α + iβ, J_t·α'' + J_p·Ω·β' = moment of x forces."""
    W, M, Jt, Jp = SPEED, 62.0, 3.1, 0.09
    k, kk, c, cc = 4.4e5, 4.4e5 * 0.04, 600.0, 600.0 * 0.04
    A, b = np.zeros((5, 5), dtype=complex), np.zeros(5, dtype=complex)
    for axis in (0, 1):
        A[axis, axis] = -M * W**2 + 1j * W * c + k
        A[2 + axis, 2 + axis] = -Jt * W**2 + 1j * W * cc + kk
    A[2, 3], A[3, 2] = 1j * W * Jp * W, -1j * W * Jp * W
    A[:4, 4] = [-friction, -1.0, -place * friction, -place]
    for z, load in loads:
        force = load * W**2
        b[0] += force
        b[1] += -1j * force
        b[2] += z * force
        b[3] += -1j * z * force
    A[4, 1], A[4, 3], A[4, 4] = 1.0, place, compliance  # y_a + q·N = i·E: touching the circle of the surface
    b[4] = 1j * runout
    return np.linalg.solve(A, b)


@pytest.mark.parametrize(("compliance", "friction"), CONTACTS)
def test_force_and_motion_are_those_of_four_freedoms(compliance: float, friction: float) -> None:
    runout = cmath.rect(4e-5, 0.7)
    contact = TiltingContact.of(ROTOR, 0.26, SPEED, compliance, friction, runout)
    x, y, a, b, force = phasors(0.26, compliance, friction, runout, WHEELS)
    assert contact.force(WHEELS) == pytest.approx(force, rel=1e-9)
    for place in (0.26, -0.2, 0.0):
        X, Y = contact.motion(place, WHEELS)
        assert pytest.approx((x + place * a, y + place * b), rel=1e-8) == (X, Y)


@pytest.mark.parametrize(("compliance", "friction"), CONTACTS)
def test_the_acting_imbalance_makes_both_races_stand_still_in_the_forward_sense(
    compliance: float, friction: float
) -> None:
    """Balls as rigid imbalances in four freedoms: no forward whirl anywhere, and the closed force."""
    runout = cmath.rect(4e-5, -0.4)
    contact = TiltingContact.of(ROTOR, 0.26, SPEED, compliance, friction, runout)
    acting = PlacedImbalance(0.26, contact.acting_imbalance())
    balls = balancing_resultants(RACES, [*WHEELS, acting])
    loads = [*WHEELS, *(PlacedImbalance(z, V) for z, V in zip(RACES, balls, strict=True))]
    x, y, a, b, force = phasors(0.26, compliance, friction, runout, loads)
    assert contact.balanced_force() == pytest.approx(force, rel=1e-9)
    for place in (0.3, -0.3, 0.26):
        X, Y = x + place * a, y + place * b
        assert abs(X + 1j * Y) / 2 < 1e-12
        assert contact.balanced_motion(place) == pytest.approx((X, Y), rel=1e-7)


def test_without_tilt_it_is_the_contact_of_one_race() -> None:
    rotor = TiltingRotor(5.6, 1e9, 0.0, (Bearing(0.0, 3e4, 40.0),))
    stiffness = rotor.dynamic_stiffness(607.0)[0][0]
    runout = cmath.rect(4e-5, 0.6)
    for compliance, friction in CONTACTS:
        contact = TiltingContact.of(rotor, 0.0, 607.0, compliance, friction, runout)
        known = SteadyContact(607.0, (stiffness, stiffness), compliance, friction)
        assert -contact.acting_imbalance() == pytest.approx(known.balancing_imbalance(runout), rel=1e-9)
        assert contact.force([PlacedImbalance(0.0, 1e-4 + 0j)]) == pytest.approx(known.normal_force(1e-4, runout))
        assert contact.whirl_per_imbalance(0.0, 0.0) == pytest.approx(known.whirl_per_imbalance, rel=1e-9)


def test_a_face_wheel_acts_on_nothing() -> None:
    contact = TiltingContact.of(ROTOR, 0.26, SPEED, 0.0, -0.35, 4e-5 + 0j, pressing=False)
    assert contact.force(WHEELS) == contact.balanced_force() == contact.acting_imbalance() == 0


def test_the_balls_mass_moves_the_backward_whirl_alone() -> None:
    """2 × 0.2 kg · (1 − 1/(8·1.4)) on 62 kg: the force of a rigid contact rises by a share of 0.6 %."""
    heavy = [PlacedImbalance(0.3, 0.2 * (1 - 1 / 11.2)), PlacedImbalance(-0.3, 0.2 * (1 - 1 / 11.2))]
    bare, laden = (TiltingContact.of(ROTOR, 0.26, SPEED, 0.0, 0.0, 4e-5 + 0j, balls) for balls in ((), heavy))
    assert 1.0 < abs(laden.balanced_force() / bare.balanced_force()) < 1.012
    assert laden.whirl_per_imbalance(0.3, 0.3) != bare.whirl_per_imbalance(0.3, 0.3)
    assert laden.rotor == bare.rotor
