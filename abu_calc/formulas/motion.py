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
    "Equations of motion, composed of a support, races of balls, and the effects of a scene",
    where=(
        "The balls feel the support as a frame with the accelerations A_f. γ_k is θ_k plus the angle of the rotor. "
        "The direction along the race is (−sin γ_k, cos γ_k), the direction outward (cos γ_k, sin γ_k).\n"
        "    ball     J R_p θ_k'' = g_t − R_p h₀ θ_k' − A_t − T_k·A_f − (dry friction) n_b,\n"
        "             n_b = R_p γ_k'² + g_r − A_r − N_k·A_f\n"
        "    frame    (M_f + Σ m (T_k T_kᵀ + N_k N_kᵀ)) A_f\n"
        "             = f_f + Σ m N_k (R_p γ_k'² − A_r) − Σ m T_k (A_t + R_p θ_k'')\n"
        "Dry friction depends on n_b, so n_b is solved together with the motion. Eliminating θ_k'' leaves the "
        "equations of the frame. Their matrix is symmetric, and positive definite without friction. The cost grows "
        "linearly with the number of balls."
    ),
    signs="J m R_p h₀ θ_k γ_k A_f T_k N_k A_t A_r g_t g_r n_b M_f f_f",
    source="Kladiev 1996, (1), and Kovalenko 2010, (1)–(3), re-derived by Lagrange's equations",
    published=(
        "Kladiev's (1) has J = 1, so its balls move faster by √(7/5). It has no damping of the support, so its free "
        "vibration never dies out"
    ),
))  # fmt: skip

SETTLING_TIME = register(Formula(
    "formulas.motion:settling_time",
    "Settling time as it is published, from full speed until the residual imbalance stays near its final value",
    f"|U(t)| ≤ mean |U| of the last turns + {SETTLED:g}·max(m₀e, 1 % of Σ m·R_p)",
    "s",
    where=(
        "Full speed counts from the end of the run-up, or of a temporary speed reduction. A start at full speed "
        "counts from t = 0. If the balls settle during the run-up, the settling time is 0. If they settle in the last "
        "5 % of the run, there is none. A quintic through six samples (16 per revolution) gives the time between two "
        "samples."
    ),
    source="own definition",
))  # fmt: skip

QUIET_TIME = register(Formula(
    "formulas.motion:quiet_time",
    "Quiet time, from full speed to the time after which the level stays low",
    "L(t) ≤ min(limit, level without balls)",
    "s",
    where=(
        "L(t) is by the rms velocity of the turn that ends at t, less its mean and its trend. The larger of both axes "
        "counts, at the loudest place that is limited. The level without balls is that of the file's imbalance at this "
        "speed. Without a limit, 1 dB above the level of the end counts, or 40 dB below that "
        "without balls if that is more. There is no quiet time if the last crossing "
        "lies in the last 5 % of the run. If a change of the threshold by 1 % moves the time by more than a tenth, "
        "a range is told."
    ),
    source="own definition",
))  # fmt: skip

REST_TIME = register(Formula(
    "formulas.motion:rest_time",
    "Rest time, from full speed to the time after which the balls keep their places",
    f"|U(t) − U_end| ≤ {SETTLED:g}·max(m₀e, 1 % of Σ m·R_p)",
    "s",
    where=(
        "U is the imbalance of rotor and balls in the rotor, with its direction. That of the end is its mean over "
        "the last twentieth. Balls that still creep have no rest time. They creep if, at their pace, U would move by "
        "more than this band in a time as long as the run. The pace is the least of that over the last twentieth and "
        "over the last quarter."
    ),
    source="own definition",
))  # fmt: skip

SIMULATE = register(Formula(
    "formulas.motion:simulate",
    (
        "Method of a simulation: the envelope (averaged motion of the balls) if its error is below the accuracy, else "
        "the equations of motion"
    ),
    where=(
        "The tolerance of the integration is tightened until the error is below the accuracy. The error of the "
        "equations is the difference between two runs a decade of tolerance apart, in amplitude, times and ball "
        "angles. There is no answer if the permitted computing work does not suffice, or if no tolerance reaches "
        "the accuracy. The motion is then chaotic, or rounding errors decide it."
    ),
    checked=(ACCURACY,),
    source="own method",
))  # fmt: skip
