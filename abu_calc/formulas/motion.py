"""What a simulation integrates and how it is judged: formulas of rooms that are heavy to import, as data alone."""

from typing import Final

from abu_calc.formula import Formula, register
from abu_calc.validity import Range

ACCURACY: Final = Range("accuracy", 1e-8, 0.5, key="accuracy")
"""What may be asked of a simulation, relative."""

SETTLED: Final = 0.1
"""Share of the rotor's own imbalance below which what balls leave of it counts as settled, and as balanced."""

HARDLY: Final = 0.01
"""Of what all balls in one place would cause: imbalance below counts as this much."""

EQUATIONS = register(Formula(
    "formulas.motion:equations",
    "The one set of equations of motion, composed of a support, races of balls, and the effects of a scene",
    where="A support is felt by the balls as a frame of d accelerations A. Ball k of mass m stands at the angle θ_k in "
    "the rotor, γ_k = θ_k + (turn of the rotor), e_r = (cos γ, sin γ), e_t = (−sin γ, cos γ). With T_k and N_k the "
    "acceleration of its place in the race per unit A along e_t and e_r, and κ_t, κ_r what that place has without A:\n"
    "    ball     J R_p θ'' = g_t − R_p h₀ θ' − κ_t − T·A − (dry friction) n,    n = R_p γ'² + g_r − κ_r − N·A\n"
    "    frame    (M_f + Σ m (T Tᵀ + N Nᵀ)) A = f + Σ m N (R_p γ'² − κ_r) − Σ m T (κ_t + R_p θ'')\n"
    "n is the normal force of ball and race per mass, so dry friction is solved with the motion. Eliminating θ'' "
    "leaves d equations, whose matrix is symmetric and positive definite without friction; the cost grows linearly "
    "with the balls. J = 1 for a point, 7/5 for a rolling ball, 3/2 for a roller.",
    source="Kladiev 1996, (1), and Kovalenko 2010, (1)–(3), re-derived by Lagrange's equations",
    printed="Kladiev's (1) has J = 1, so its balls move faster by √(7/5), and no damping of the support, so its free "
    "vibration never dies",
))  # fmt: skip

SETTLING_TIME = register(Formula(
    "formulas.motion:settling_time",
    "Earliest time after which the imbalance left stays near where it ends",
    f"|U(t)| ≤ mean |U| of the last turns + {SETTLED:g}·max(m₀e, 1 % of Σ m·R_p)",
    "s",
    where="None when that is in the last 5 % of the run. Between two samples, 16 per revolution, it is read from the "
    "quintic through the six about them.",
    source="own definition",
))  # fmt: skip

SIMULATE = register(Formula(
    "formulas.motion:simulate",
    "The envelope (averaged motion of the balls) where its error is below the accuracy; otherwise the equations of "
    "motion, tightened until that holds",
    where="The error of the equations is the difference of two runs a decade of tolerance apart, in amplitude, "
    "settling time and ball angles. There is no answer when the work does not suffice, or when no tolerance reaches "
    "the accuracy: the motion is then chaotic, or decided by less than rounding.",
    checked=(ACCURACY,),
    source="own method",
))  # fmt: skip
