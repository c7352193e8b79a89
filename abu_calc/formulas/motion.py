"""Equations of motion and criteria of a simulation, registered as data.

These are formulas of modules that are heavy to import.
"""

from typing import Final

from abu_calc.foundation.formula import Formula, register
from abu_calc.foundation.validity import Range

ACCURACY: Final = Range("accuracy", 1e-8, 0.5, key="accuracy")
"""Accuracy that may be asked of a simulation, relative."""

SETTLED: Final = 0.1
"""Share of the rotor's own imbalance below which what balls leave of it counts as settled, and as balanced."""

HARDLY: Final = 0.01
"""Least imbalance that counts, as a share of the imbalance of all balls in one place.

A smaller imbalance counts as this much.
"""

EQUATIONS = register(Formula(
    "formulas.motion:equations",
    "The one set of equations of motion, composed of a support, races of balls, and the effects of a scene",
    where="A support is felt by the balls as a frame with accelerations of its own. γ_k = θ_k + (turn of the rotor), "
    "along the race is (−sin γ_k, cos γ_k), outward (cos γ_k, sin γ_k).\n"
    "    ball     J R_p θ_k'' = g_t − R_p h₀ θ_k' − A_t − T_k·A_f − (dry friction) n_b,\n"
    "             n_b = R_p γ_k'² + g_r − A_r − N_k·A_f\n"
    "    frame    (M_f + Σ m (T_k T_kᵀ + N_k N_kᵀ)) A_f\n"
    "             = f_f + Σ m N_k (R_p γ_k'² − A_r) − Σ m T_k (A_t + R_p θ_k'')\n"
    "n_b is solved with the motion, since dry friction hangs on it. Eliminating θ_k'' leaves those of the frame, "
    "whose matrix is symmetric and positive definite without friction; the cost grows linearly with the balls.",
    signs="J m R_p h₀ θ_k γ_k A_f T_k N_k A_t A_r g_t g_r n_b M_f f_f",
    source="Kladiev 1996, (1), and Kovalenko 2010, (1)–(3), re-derived by Lagrange's equations",
    printed="Kladiev's (1) has J = 1, so its balls move faster by √(7/5), and no damping of the support, so its free "
    "vibration never dies",
))  # fmt: skip

SETTLING_TIME = register(Formula(
    "formulas.motion:settling_time",
    "Settling time: from full speed to the time after which the imbalance left stays near its final value",
    f"|U(t)| ≤ mean |U| of the last turns + {SETTLED:g}·max(m₀e, 1 % of Σ m·R_p)",
    "s",
    where="Full speed is reached for good after the run-up and any pause below it; a start at full speed counts from "
    "t = 0. Zero if the balls settle during the run-up. None if they settle in the last 5 % of the run. Between two "
    "samples, 16 per revolution, the time is read from the quintic through the six about them.",
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
