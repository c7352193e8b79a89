"""Meaning of a column's name in a recorded motion: time or motion, its quantity, its unit."""

import re
from typing import Final

from abu_calc.frozen import dataclass
from abu_calc.spec.recording import MotionQuantity
from abu_calc.units import GRAVITY

TIME: Final = {"s": 1.0, "sec": 1.0, "с": 1.0, "ms": 1e-3, "мс": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0}
_SPELLED: Final[tuple[tuple[MotionQuantity, float, str], ...]] = (
    ("acceleration", 1.0, "m/s² m/s^2 m/s2 m/s/s m_per_s2 m/s**2 м/с² м/с^2 м/с2"),
    ("acceleration", 1e-3, "mm/s² mm/s^2 mm/s2 mm_per_s2 мм/с² мм/с2"),
    ("acceleration", GRAVITY, "g gn g0"),
    ("velocity", 1.0, "m/s m_per_s м/с"),
    ("velocity", 1e-3, "mm/s mm_per_s мм/с"),
    ("velocity", 1e-6, "um/s µm/s μm/s um_per_s мкм/с"),
    ("velocity", 1e-2, "cm/s cm_per_s см/с"),
    ("displacement", 1.0, "m м"),
    ("displacement", 1e-3, "mm мм"),
    ("displacement", 1e-6, "um µm μm micron мкм"),
)
MOTION: Final = {unit: (quantity, size) for quantity, size, units in _SPELLED for unit in units.split()}
"""Units of a column: its quantity, and the value in SI."""
WORDS: Final[dict[str, MotionQuantity]] = {
    **dict.fromkeys(("a", "ax", "ay", "az", "acc", "accel", "acceleration"), "acceleration"),
    **dict.fromkeys(("v", "vx", "vy", "vz", "vel", "velocity"), "velocity"),
    **dict.fromkeys(("disp", "displacement"), "displacement"),
}
TIMES: Final = frozenset({"t", "time", "times", "zeit", "время"})
AXIS: Final = re.compile(r"(ch(annel)?[\s_]*\d+|column \d+|(.*[\s_])?[xyz])", re.IGNORECASE)
"""Names of columns that may be axes though they tell no quantity."""
BRACKETS: Final = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]\s*$")


@dataclass(frozen=True)
class Column:
    """A column by its name: its quantity (None: not known), time or not, SI per unit (None: no unit is named)."""

    name: str
    quantity: MotionQuantity | None
    is_time: bool
    unit: float | None


def column_of(name: str) -> Column:
    """Meaning of a column's name, such as "vx_mm_per_s", "a [m/s^2]", "Time (ms)".

    >>> column_of("vx_mm_per_s").quantity, column_of("t_s").is_time, column_of("a [g]").unit
    ('velocity', True, 9.80665)
    """
    match = BRACKETS.match(name)
    word, unit = (match[1], match[2].replace(" ", "")) if match else (name, "")
    bare = re.split(r"[_\s]", word.strip().lower())[0]
    if not match:
        endings = (key for key in (*MOTION, *TIME) if word.endswith(f"_{key}"))
        unit = max(endings, key=len, default="")
    known = MOTION.get(unit) or MOTION.get(unit.lower())
    if bare in TIMES or unit.lower() in TIME:
        return Column(name, None, True, TIME.get(unit.lower()))
    quantity, size = known or (WORDS.get(bare), None)
    return Column(name, quantity, False, size)
