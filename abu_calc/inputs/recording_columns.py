"""Meaning of the columns of a recording: time, sample number or motion, with quantity, unit and place.

Names are read as people write them: a unit stands in brackets, behind a comma, a slash, an underscore or a blank.
"""

import re
from typing import Final, Literal

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY

MotionQuantity = Literal["acceleration", "velocity", "displacement"]
QUANTITIES: Final[tuple[MotionQuantity, ...]] = ("acceleration", "velocity", "displacement")

_TIMES: Final = (
    (1.0, "s sec secs second seconds с сек 秒"),
    (1e-3, "ms msec msecs millis millisecond milliseconds мс мсек 毫秒"),
    (1e-6, "us usec micros microsecond microseconds мкс"),
    (1e-9, "ns nsec nanos nanosecond nanoseconds нс"),
    (60.0, "min minute minutes мин"),
)
TIME: Final = {unit: size for size, units in _TIMES for unit in units.split()}
"""Units of time as `plain_unit` writes them [s]."""
_MOTIONS: Final[tuple[tuple[MotionQuantity, float, str], ...]] = (
    ("acceleration", 1.0, "m/s2 m/s/s m_per_s2 ms-2 м/с2 ms2 m_s2 mps2 m.s-2"),
    ("acceleration", 1e-3, "mm/s2 mm_per_s2 мм/с2"),
    ("acceleration", 1e-2, "cm/s2 см/с2 gal"),
    ("acceleration", GRAVITY, "g gn g0 g_n gs g's gforce g-force"),
    ("acceleration", 1e-3 * GRAVITY, "mg milli-g"),
    ("acceleration", 1e-6 * GRAVITY, "ug"),
    ("velocity", 1.0, "m/s m_per_s ms-1 м/с"),
    ("velocity", 1e-3, "mm/s mm_per_s mms-1 мм/с"),
    ("velocity", 1e-6, "um/s um_per_s мкм/с"),
    ("velocity", 1e-2, "cm/s cm_per_s см/с"),
    ("displacement", 1.0, "m м"),
    ("displacement", 1e-3, "mm мм"),
    ("displacement", 1e-6, "um micron microns мкм"),
)
MOTION: Final = {unit: (quantity, size) for quantity, size, units in _MOTIONS for unit in units.split()}
"""Units of motion as `plain_unit` writes them: quantity, and the value in SI."""
VOLTS: Final = {"V": 1.0, "Volt": 1.0, "Volts": 1.0, "mV": 1e-3, "uV": 1e-6, "В": 1.0, "мВ": 1e-3, "мкВ": 1e-6}
"""Units of a column that a sensor's sensitivity turns into motion [V]."""
_WORDS: Final[tuple[tuple[MotionQuantity, str], ...]] = (
    ("acceleration", "a ax ay az acc accx accy accz accel accelx accely accelz acceleration accelerometer gfx gfy gfz "
     "beschleunigung schwingbeschleunigung accélération accelerazione aceleración ускорение виброускорение 加速度"),
    ("velocity", "v vx vy vz vel velocity geschwindigkeit schwinggeschwindigkeit schnelle vitesse velocità velocidad "
     "скорость виброскорость 速度"),
    ("displacement", "disp displacement weg auslenkung schwingweg déplacement spostamento desplazamiento перемещение "
     "виброперемещение"),
)  # fmt: skip
WORDS: Final = {word: quantity for quantity, words in _WORDS for word in words.split()}
_TIME_WORDS: Final = (
    "t time times timestamp timestamps datetime date clock elapsed epoch zeit zeitstempel uhrzeit время temps "
    "horodatage tempo tiempo czas tijd tid 时间 時間"
)
TIMES: Final = frozenset(_TIME_WORDS.split())
_COUNTS: Final = (
    "sample samples samplenumber n no nr # index idx i k count counter packet packetcounter packetid row line "
    "frame messwert 序号 номер отсчёт отсчет"
)
COUNTS: Final = frozenset(_COUNTS.split())
"""Words of a column that numbers the rows."""
_MARKS: Final = "mark tacho tach key keyphasor pulse trigger rpm метка тахо"
MARKS: Final = frozenset(_MARKS.split())
"""Words of a column that tells when a mark passes, or how fast it does."""
_RESULTANTS: Final = (
    "at gft tgf total resultant magnitude mag norm absolute abs |a| |v| vectorsum sum svm betrag gesamt absolut "
    "resultierende модуль полное суммарное"
)
RESULTANTS: Final = frozenset(_RESULTANTS.split())
"""Words of a column that holds the length of the vector whose components stand beside it."""
AXIS: Final = re.compile(r"(ch(annel)?[\s_]*\d+|column \d+|(.*[\s_])?[xyz])", re.IGNORECASE)
"""Names of columns that may be axes though they tell no quantity."""
AXIS_WORDS: Final = re.compile(r"(a|v|acc|accel|gf)?[xyz]|achse|axis|ось|轴")
"""Words of a column's name that say its axis."""
_NO_HANDLE: Final = "signal sensor channel ch column vibration датчик канал linear lin user raw"
NO_HANDLE: Final = WORDS.keys() | frozenset(_NO_HANDLE.split())
"""Words of a column's name that name no handle."""
IMPERIAL: Final = frozenset({"in", "inch", "ips", "mil", "mils", "ft", "db"})
"""Units that are not read: imperial ones, and levels."""
BRACKETS: Final = re.compile(r"[\[(]\s*([^\[\]()]+?)\s*[\])]")
RANGE: Final = re.compile(r"[±+\-/]*\d+(\.\d+)?g")
BARE_RANGE: Final = re.compile(r"(?<=[\s_])[±+\-/]*\d+(?:\.\d+)?\s?[gG](?=$|[\s_])")
STRANGE: Final = re.compile(r".*rms|counts?|cnts?|lsb|adc|digits?|raw|bits?|gal|.*g", re.IGNORECASE)
"""Text in brackets that can only be a unit, and is none that is read."""
FULL_WIDTH: Final = str.maketrans("（）［］，；：／", "()[],;:/")
_PLAIN: Final = (
    (r"[\s·⋅*^()\[\]]", ""),
    ("(?<=/s)(Â²|�|\\?)", "2"),
    ("²", "2"),
    ("⁻", "-"),
    ("¹", "1"),
    ("[µμ]", "u"),
    ("sec(?=2|$)", "s"),
)


@dataclass(frozen=True)
class RecordingColumn:
    """A column by its name: its quantity (None: not known), time or not, SI per unit (None: no unit is named).

    `numbers_rows`: sample numbers; `is_resultant`: length of a vector; `volts`: volts per unit of a column that needs a
    sensitivity; `place`: words before its axis, which name a handle where they differ; `names_axis`: whether a word is
    an axis; `unknown_unit`: text that can only be a unit and is none of this table; `range`: of the sensor, as named.
    """

    name: str
    quantity: MotionQuantity | None
    is_time: bool
    unit: float | None
    volts: float | None = None
    place: str = ""
    names_axis: bool = False
    unknown_unit: str = ""
    range: str = ""
    numbers_rows: bool = False
    is_resultant: bool = False

    @property
    def may_be_axis(self) -> bool:
        """True if the name says an axis, though maybe no quantity."""
        return self.names_axis or AXIS.fullmatch(self.name) is not None


def column_of(name: str) -> RecordingColumn:
    """Meaning of a column's name, such as "vx_mm_per_s", "a [m/s^2]", "Time (ms)", "Ax, м/с²", "t/s".

    >>> column_of("vx_mm_per_s").quantity, column_of("t/s").is_time, column_of("a [g]").unit
    ('velocity', True, 9.80665)
    >>> column_of("X (40g)").unit, column_of("X (40g)").range, column_of("Linear Acceleration x (m/s^2)").place
    (None, '40g', '')
    """
    word, unit, spread = _parted(name.translate(FULL_WIDTH))
    word = re.sub(r"([^\W\d_]*)([xyzXYZ])轴", r"\1 \2 ", word)
    parts = [part for part in re.split(r"[_\s.:,/-]+", word) if part]
    whole = WORDS.keys() | RESULTANTS
    words = [
        piece for part in parts
        for piece in ([part] if part.lower() in whole else re.sub(r"(?<=[a-zа-я])(?=[A-Z])", " ", part).split())
    ]  # fmt: skip
    lower = [part.lower() for part in words]
    plain = plain_unit(unit)
    motion, volts = MOTION.get(plain), _volts(unit)
    unknown = unit if motion is None and volts is None and plain not in TIME else ""
    # "seconds_elapsed", but not a channel "NS"
    spelled = next((TIME[part] for part in lower if part in TIME and len(part) > 3), None)
    timed = bool(TIMES & set(lower) or spelled) and not (unit or MARKS & set(lower))
    if plain in TIME or timed:
        return RecordingColumn(name, None, True, TIME.get(plain, spelled))
    if not unit and set(lower) <= COUNTS:
        return RecordingColumn(name, None, False, None, numbers_rows=True)
    joined, axes = "".join(lower), [part for part in lower if AXIS_WORDS.fullmatch(part)]
    worded: MotionQuantity | None = next((WORDS[part] for part in (*lower, joined) if part in WORDS), None)
    quantity, size = motion or (worded, None)
    if "gravity" in lower:
        quantity, size = None, None  # the pull that a phone has taken off
    elif (
        quantity == "acceleration" and not unit and any(part.startswith("gf") or part in ("g", "mg") for part in lower)
    ):
        size = 1e-3 * GRAVITY if "mg" in lower else GRAVITY  # gFx, acc_g_x
    resultant = bool(RESULTANTS & {*lower, joined}) and not axes
    place = " ".join(part for part in words if part.lower() not in NO_HANDLE and part.lower() not in axes
                     and not part.isdecimal()) if axes else ""  # fmt: skip
    return RecordingColumn(
        name, quantity, False, size, volts, place, bool(axes), unknown, spread, is_resultant=resultant
    )


def plain_unit(text: str) -> str:
    """A unit in one of its spellings.

    >>> plain_unit("m/s²"), plain_unit("M/S^2"), plain_unit("m·s⁻²"), plain_unit("µm/s")
    ('m/s2', 'm/s2', 'ms-2', 'um/s')
    """
    for pattern, plain in _PLAIN:
        text = re.sub(pattern, plain, text)
    return text.lower()


def is_unit(text: str) -> bool:
    """True for a unit of time, motion or voltage."""
    return plain_unit(text) in TIME.keys() | MOTION.keys() or _volts(text) is not None


def _volts(unit: str) -> float | None:
    """Volts of a unit of voltage, in brackets or without; None for another."""
    return VOLTS.get(re.sub(r"[()\[\]\s]", "", unit).replace("µ", "u").replace("μ", "u"))


def _parted(name: str) -> tuple[str, str, str]:
    """The words of a name, its unit ("": none), and the range of its sensor ("": none)."""
    word, found, spread = name, "", ""
    for match in BRACKETS.finditer(name):
        text = match[1]
        if RANGE.fullmatch(plain_unit(text)):
            spread = text
        elif is_unit(text) or (not found and _can_only_be_unit(text)):
            found = text
        word = word.replace(match[0], " ")
    if not spread and (bare := BARE_RANGE.search(word)):
        spread, word = bare[0].strip(), word.replace(bare[0], " ")
    word = word.rstrip(" /,;_")
    if found:
        return word, found, spread
    for sign in (",", "/", "_", " "):
        # The longest ending that is a unit: "vx_mm_per_s", "a/m/s²".
        for place in (k for k, letter in enumerate(word) if letter == sign and k):
            ending = word[place + 1 :].strip()
            if is_unit(ending) and (sign != " " or len(ending) > 1):
                return word[:place], ending, spread
    _, comma, ending = word.rpartition(",")
    return (
        (word.rpartition(",")[0], ending.strip(), spread) if comma and _can_only_be_unit(ending) else (word, "", spread)
    )


def _can_only_be_unit(text: str) -> bool:
    """True for text that is a quotient or an imperial unit."""
    plain = text.strip()
    quotient = "/" in plain and ":" not in plain and len(plain) <= 12
    return quotient or plain.lower() in IMPERIAL or STRANGE.fullmatch(plain) is not None
