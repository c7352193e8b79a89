"""Meaning of the columns of a recording: time or motion, quantity, unit, and the handle it was measured at."""

import re
from typing import Final, Literal

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY

MotionQuantity = Literal["acceleration", "velocity", "displacement"]
QUANTITIES: Final[tuple[MotionQuantity, ...]] = ("acceleration", "velocity", "displacement")

TIME: Final = {"s": 1.0, "sec": 1.0, "с": 1.0, "ms": 1e-3, "мс": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0}
_SPELLED: Final[tuple[tuple[MotionQuantity, float, str], ...]] = (
    ("acceleration", 1.0, "m/s² m/s^2 m/s2 m/s/s m_per_s2 m/s**2 м/с² м/с^2 м/с2 ms-2 ms^-2 ms⁻² m·s⁻²"),
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
VOLTS: Final = {"V": 1.0, "mV": 1e-3, "µV": 1e-6, "μV": 1e-6, "uV": 1e-6, "В": 1.0, "мВ": 1e-3, "мкВ": 1e-6}
"""Units of a column that a sensor's sensitivity turns into motion [V]."""
WORDS: Final[dict[str, MotionQuantity]] = {
    **dict.fromkeys(("a", "ax", "ay", "az", "acc", "accel", "acceleration"), "acceleration"),
    **dict.fromkeys(("v", "vx", "vy", "vz", "vel", "velocity"), "velocity"),
    **dict.fromkeys(("disp", "displacement"), "displacement"),
}
TIMES: Final = frozenset({"t", "time", "times", "zeit", "время"})
AXIS: Final = re.compile(r"(ch(annel)?[\s_]*\d+|column \d+|(.*[\s_])?[xyz])", re.IGNORECASE)
"""Names of columns that may be axes though they tell no quantity."""
AXIS_WORDS: Final = frozenset({"x", "y", "z", "ax", "ay", "az", "vx", "vy", "vz"})
"""Last words of a column's name that say its axis."""
_NOT_HANDLES: Final = (
    "signal sensor channel ch column axis vibration датчик канал виброускорение виброскорость ускорение скорость"
)
IMPERIAL: Final = frozenset({"in", "inch", "ips", "mil", "mils", "ft", "db"})
"""Units in brackets that are not read: imperial ones, and levels."""
NO_HANDLE: Final = frozenset({*WORDS, *_NOT_HANDLES.split()})
"""Words of a column's name that name no handle."""
BRACKETS: Final = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]\s*$")


@dataclass(frozen=True)
class RecordingColumn:
    """A column by its name: its quantity (None: not known), time or not, SI per unit (None: no unit is named).

    `volts`: volts per unit of a column that needs a sensitivity; `handle`: where it was measured, "" if it names none;
    `names_axis`: whether its last word is an axis; `unknown_unit`: text in brackets that is no unit of this table.
    """

    name: str
    quantity: MotionQuantity | None
    is_time: bool
    unit: float | None
    volts: float | None = None
    handle: str = ""
    names_axis: bool = False
    unknown_unit: str = ""

    @property
    def may_be_axis(self) -> bool:
        """True if the name says an axis, though maybe no quantity."""
        return AXIS.fullmatch(self.name) is not None


def column_of(name: str) -> RecordingColumn:
    """Meaning of a column's name, such as "vx_mm_per_s", "a [m/s^2]", "Time (ms)".

    >>> column_of("vx_mm_per_s").quantity, column_of("t_s").is_time, column_of("a [g]").unit
    ('velocity', True, 9.80665)
    """
    match = BRACKETS.match(name)
    word, unit = (match[1], match[2].replace(" ", "")) if match else (name, "")
    if not match:
        endings = (key for key in (*MOTION, *TIME, *VOLTS) if word.endswith(f"_{key}"))
        unit = max(endings, key=len, default="")
        word = word.removesuffix(f"_{unit}")
    words = [part for part in re.split(r"[_\s.:]+", word.strip()) if part] or [""]
    first, last = words[0].lower(), words[-1].lower()
    known = MOTION.get(unit) or MOTION.get(unit.lower())
    if first in TIMES or unit.lower() in TIME:
        return RecordingColumn(name, None, True, TIME.get(unit.lower()))
    quantity, size = known or (WORDS.get(first) or (WORDS.get(last) if last in AXIS_WORDS else None), None)
    volts = VOLTS.get(unit)
    unknown = unit if match and size is None and volts is None and _is_unit(unit) else ""
    return RecordingColumn(name, quantity, False, size, volts, _handle(words), last in AXIS_WORDS, unknown)


def _is_unit(text: str) -> bool:
    """True for text in brackets that can only be a unit, as it is a quotient or an imperial one."""
    return "/" in text or text.lower() in IMPERIAL


def _handle(words: list[str]) -> str:
    """Words before the axis that are a place, such as "front" of "front_ax_m_per_s2"; "" without such words.

    >>> _handle(["front", "ax"]), _handle(["ax"]), _handle(["Acc", "rear", "x"]), _handle(["front"])
    ('front', '', 'rear', '')
    """
    if len(words) < 2 or words[-1].lower() not in AXIS_WORDS:
        return ""
    return " ".join(part for part in words[:-1] if part.lower() not in NO_HANDLE and not part.isdecimal())
