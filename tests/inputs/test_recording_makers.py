"""Recordings as loggers, phones and spreadsheets write them: 4, 3 and 1 m/s² rms at 80 Hz, in many files."""

import math
import random
from collections.abc import Callable, Mapping
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from abu_calc.foundation.errors import AbuError, InputError
from abu_calc.foundation.units import GRAVITY
from abu_calc.inputs.recording import Recording
from abu_calc.inputs.recording_files import read_recording

RATE, COUNT = 1000, 2400
T = np.arange(COUNT) / RATE
PHASE = math.tau * 80 * T
MOTION = math.sqrt(2) * np.stack([4 * np.sin(PHASE), 3 * np.cos(PHASE), np.sin(PHASE + 0.3)], axis=1)
HELD = MOTION + np.array([0.0, 0.0, GRAVITY])
LENGTH = np.linalg.norm(MOTION, axis=1)
MIDNIGHT = datetime(2026, 5, 1, 23, 59, 59)

Line = Callable[[int], str]


def cells(*columns: np.ndarray, sign: str = ",", comma: bool = False, form: str = ".6f") -> Line:
    """Rows of columns."""
    return lambda k: sign.join(f"{column[k]:{form}}".replace(".", "," if comma else ".") for column in columns)


def clock(form: str, after: Line, sign: str = ",", cut: int = 3) -> Line:
    """Rows that begin with a time of day."""
    return lambda k: (MIDNIGHT + timedelta(seconds=k / RATE)).strftime(form)[: -cut or None] + sign + after(k)


def axes(values: np.ndarray, unit: float = 1.0) -> tuple[np.ndarray, ...]:
    """The three axes in a unit [m/s²]."""
    return tuple(values.T / unit)


FILES: Mapping[str, tuple[str, Line, str]] = {
    "phone, resultant": (
        '"Time (s)","Linear Acceleration x (m/s^2)","Linear Acceleration y (m/s^2)","Linear Acceleration z (m/s^2)",'
        '"Absolute acceleration (m/s^2)"\n',
        cells(T, *axes(MOTION), LENGTH),
        "resultant",
    ),
    "phone, comments": (
        "# App\n# Requested Sample Rate: 50 Hz\ntime,ax (m/s^2),ay (m/s^2),az (m/s^2),aT (m/s^2)\n",
        cells(T, *axes(MOTION), LENGTH),
        "resultant",
    ),
    "phone, unnamed resultant": (
        "t_s,x [m/s²],y [m/s²],z [m/s²],q [m/s²]\n",
        cells(T, *axes(MOTION), LENGTH),
        "result",
    ),
    "phone, in g": ("time,gFx,gFy,gFz,TgF\n", cells(T, *axes(MOTION, GRAVITY), LENGTH / GRAVITY), "resultant"),
    "phone, epoch": (
        "time,seconds_elapsed,z,y,x\n",
        lambda k: f"{1_700_000_000_000_000_000 + 1_000_000 * k}," + cells(T, *axes(HELD))(k),
        "gravity",
    ),
    "phone, milliseconds since 1970": (
        "time,ax,ay,az\n",
        lambda k: f"{1_700_000_000_000 + k}," + cells(*axes(HELD, GRAVITY))(k),
        "since 1970",
    ),
    "phone, words run together": (
        "loggingTime(txt),accelerometerTimestamp_sinceReboot(s),accelerometerAccelerationX(G),"
        "accelerometerAccelerationY(G),accelerometerAccelerationZ(G)\n",
        clock("%Y-%m-%d %H:%M:%S.%f", cells(T, *axes(MOTION, GRAVITY))),
        "",
    ),
    "sep": ("sep=;\nt_s;ax_g;ay_g;az_g\n", cells(T, *axes(MOTION, GRAVITY), sign=";", comma=True), "decimal"),
    "sep, four lines": (
        "sep=\t\nTimestamp\tAccel_X\tAccel_Y\tAccel_Z\nCAL\tCAL\tCAL\tCAL\nms\tm/(s^2)\tm/(s^2)\tm/(s^2)\n",
        lambda k: cells(1000 * T, *axes(MOTION), sign="\t")(k) + "\t",
        "above the names",
    ),
    "Russian": (
        "Время, мс;Ax, м/с²;Ay, м/с²;Az, м/с²\n",
        cells(1000 * T, *axes(MOTION), sign=";", comma=True),
        "decimal",
    ),
    "slash": ("t/s;ax/(m/s²);ay/(m/s²);az/(m/s²)\n", cells(T, *axes(MOTION), sign=";", comma=True), "decimal"),
    "quoted": ('"Time, s","ax, m/s2","ay, m/s2","az, m/s2"\n', cells(T, *axes(MOTION)), ""),
    "quoted numbers": (
        '"Time, s","ax, m/s2","ay, m/s2","az, m/s2"\n',
        lambda k: ",".join(f'"{each}"'.replace(".", ",") for each in cells(T, *axes(MOTION))(k).split(",")),
        "decimal",
    ),
    "German": (
        "Messzeit [s];Beschleunigung X [m/s²];Beschleunigung Y [m/s²];Beschleunigung Z [m/s²]\n",
        cells(T, *axes(MOTION), sign=";", comma=True),
        "decimal",
    ),
    "printer, commented names": ("#time,accel_x,accel_y,accel_z\n", cells(100 + T, *axes(1000 * HELD)), "in mm/s²"),
    "printer, trailer": (
        "Sample,X,Y,Z\n",
        lambda k: (
            f"{k},"
            + cells(*axes(HELD, GRAVITY), form=".4f")(k)
            + ("\nRate 1000, overflows 7" if k + 1 == COUNT else "")
        ),
        "overflows",
    ),
    "rate in a comment": (
        "# count, a_x, a_y, a_z; 1000 Hz\n",
        lambda k: f"{k}," + cells(*axes(MOTION))(k),
        "1000 samples",
    ),
    "units in a second line": (
        "Time;Ax;Ay;Az\n(ms);(mg);(mg);(mg)\n\n",
        cells(1000 * T, *axes(MOTION, GRAVITY / 1000), sign=";", comma=True),
        "decimal",
    ),
    "serial numbers": (
        '"Plot Title: grinder"\n"#","Date Time, GMT-04:00",'
        + ",".join(f'"{axis} Accel, g (LGR S/N: 10, SEN S/N: 7)"' for axis in "XYZ")
        + "\n",
        lambda k: f"{k + 1}," + clock("%m/%d/%y %H:%M:%S.%f", cells(*axes(MOTION, GRAVITY)))(k),
        "Line 1",
    ),
    "no names, dates": ("", clock("%Y-%m-%d %H:%M:%S.%f", cells(*axes(HELD, GRAVITY))), "gravity"),
    "dates of words": ("Timestamp,X,Y,Z\n", clock("%d-%b-%Y %H:%M:%S.%f", cells(*axes(HELD))), "gravity"),
    "whole seconds": (
        "Date,Time,ax [g],ay [g],az [g]\n",
        clock("%d.%m.%Y,%H:%M:%S", cells(*axes(MOTION, GRAVITY)), cut=0),
        "too coarse",
    ),
    "milliseconds without a unit": (
        "millis,ax,ay,az\n",
        cells(5000 + 1000 * T, *axes(HELD, GRAVITY), form=".5f"),
        "gravity",
    ),
    "row numbers first": (",time,x,y,z\n", lambda k: f"{k}," + cells(T, *axes(HELD))(k), "gravity"),
    "range": ('"Time","X (40g)","Y (40g)","Z (40g)"\n', cells(T, *axes(HELD, GRAVITY)), "gravity"),
    "microseconds, other sensors": (
        "Timestamp [us]\tA_X [mg]\tA_Y [mg]\tA_Z [mg]\tG_X [mdps]\tT, °C\n",
        cells(1e6 * T, *axes(HELD, GRAVITY / 1000), LENGTH, 0 * T + 25, sign="\t"),
        "no unit",
    ),
    "two handles, resultants": (
        "t_s,"
        + ",".join(f"{place}_{axis} [m/s²]" for place in ("front", "rear") for axis in ("x", "y", "z", "total"))
        + "\n",
        cells(T, *axes(MOTION), LENGTH, *axes(MOTION), LENGTH),
        "resultant",
    ),
}


def read(folder: Path, text: str | bytes, **asked: object) -> Recording:
    file = folder / "r.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_recording(str(file), **asked)  # type: ignore[arg-type]


def text_of(name: str) -> str:
    head, row, _ = FILES[name]
    return head + "\n".join(map(row, range(COUNT))) + "\n"


def deviations(recording: Recording) -> list[float]:
    return sorted(float(np.std(values)) for values in recording.samples)


def right(recording: Recording) -> bool:
    rms = sorted([1.0, 3.0, 4.0] * (len(recording.samples) // 3))
    return recording.rate == pytest.approx(RATE, rel=1e-4) and deviations(recording) == pytest.approx(rms, rel=2e-3)


@pytest.mark.parametrize("name", FILES)
def test_a_file_of_any_maker_gives_the_signal(tmp_path: Path, name: str) -> None:
    """What is left out or concluded is told, and nothing else; several places only where words differ."""
    recording = read(tmp_path, text_of(name))
    assert right(recording), (recording.rate, recording.names, recording.remarks)
    told = FILES[name][2]
    assert told in " ".join(recording.remarks) if told else not recording.remarks
    assert set(recording.handles) == ({"front", "rear"} if name.startswith("two handles") else set())


@pytest.mark.parametrize(("head", "columns", "word", "asked"), [
    ("Sample,X,Y,Z\n", (1000 * T, *axes(MOTION)), "--rate HZ", {"rate_hz": 1000.0}),
    ("", ((np.arange(COUNT) % 20 < 2) * 5.0, *axes(MOTION)), "--rate HZ",
     {"rate_hz": 1000.0, "channels": ["2", "3", "4"], "quantity": "acceleration"}),
    ("tacho,ax,ay,az\n", ((np.arange(COUNT) % 20 < 2) * 5.0, *axes(MOTION)), "--rate HZ", {"rate_hz": 1000.0}),
    ("t,ax [g],ay [g],az [g]\n", (1e6 * T, *axes(MOTION, GRAVITY)), '--time "t:ms"', {"time": "t:us"}),
    ("ticks,ax [g],ay [g],az [g]\n", (1e3 * T, *axes(MOTION, GRAVITY)), "--time COLUMN:ms", {"time": "1:ms"}),
    ("Time,X (40g),Y (40g),Z (40g)\n", (T, *axes(MOTION, GRAVITY)), "--scale 9.80665", {"scale": 9.80665}),
    ("two,words\n", (T, *axes(MOTION)), "--skip 1", {"skip": 1}),
    ("# 1000 Hz\n# 2000 Hz\nn,ax,ay,az\n", (1000 * T, *axes(MOTION)), "several lines", {"rate_hz": 1000.0}),
])  # fmt: skip
def test_what_a_file_does_not_tell_is_asked_for_and_helps(
    tmp_path: Path, head: str, columns: tuple[np.ndarray, ...], word: str, asked: dict[str, object]
) -> None:
    text = head + "\n".join(map(cells(*columns), range(COUNT))) + "\n"
    with pytest.raises(InputError) as refused:
        read(tmp_path, text)
    assert word in str(refused.value)
    assert right(read(tmp_path, text, **asked))


@pytest.mark.parametrize(("asked", "word"), [
    ({"rate_hz": 0.0}, "rate"), ({"rate_hz": 1.0, "time": "t_s"}, "both"), ({"time": "t_s:days"}, "not a unit of time"),
    ({"time": "no"}, "no such channel"), ({"skip": -1}, "not a number of lines"),
])  # fmt: skip
def test_options_that_make_no_sense_are_refused(tmp_path: Path, asked: dict[str, object], word: str) -> None:
    with pytest.raises(InputError, match=word):
        read(tmp_path, text_of("phone, unnamed resultant"), **asked)


@pytest.mark.parametrize("line", [
    "# Bandwidth: 1000 Hz", "# filter = 488 Hz", "# Sensor resonance 25 kHz", "# Speed: 4800 rpm (80 Hz)",
    "# baud rate 115200", "# Sample rate: 12800 Hz, decimation 4", "# Samples: 2400",
])  # fmt: skip
def test_a_frequency_is_no_rate_unless_the_line_says_so(tmp_path: Path, line: str) -> None:
    text = f"{line}\nx_g,y_g,z_g\n" + "\n".join(map(cells(*axes(MOTION, GRAVITY)), range(COUNT)))
    with pytest.raises(InputError, match="--rate HZ"):
        read(tmp_path, text)


@pytest.mark.parametrize("line", [
    "# Sample rate: 1,000 Hz", "# data_rate = 1000.0 Hz, filter = 488 Hz", "Abtastrate [Hz];1000",
    "SampleRate, 1000,Hz", "# sample period 1 ms", "# 1 kSa/s", "Частота дискретизации, Гц;1000",
    "// Update Rate: 1000.0Hz", "# 采样率: 1000 Hz",
])  # fmt: skip
def test_a_rate_in_so_many_words_is_used(tmp_path: Path, line: str) -> None:
    text = f"{line}\nx_g,y_g,z_g\n" + "\n".join(map(cells(*axes(MOTION, GRAVITY)), range(COUNT)))
    assert right(read(tmp_path, text))


@pytest.mark.parametrize(("head", "unit"), [
    ("# units: g\nt_s,x,y,z\n", GRAVITY), ("# Columns: t, ax, ay, az\n# Units: s, g, g, g\nt,ax,ay,az\n", GRAVITY),
    ("t_s,acc_g_x,acc_g_y,acc_g_z\n", GRAVITY), ("t_s,X (Gal),Y (Gal),Z (Gal)\n", 0.01),
    ("# t_s,x,y,z\n# s,g,g,g\n", GRAVITY), ("t_s,x [m/s?],y [m/s?],z [m/s?]\n", 1.0),
    ('"t\n[s]",ax [g],ay [g],az [g]\n', GRAVITY), ("t_s,X [g],Y [g],Z [g],Comment\n", GRAVITY),
])  # fmt: skip
def test_units_that_stand_elsewhere_are_used(tmp_path: Path, head: str, unit: float) -> None:
    recording = read(tmp_path, head + "\n".join(map(cells(T, *axes(MOTION, unit)), range(COUNT))))
    assert right(recording) and not recording.assumed, recording.remarks


@pytest.mark.parametrize("unit", ["gRMS", "counts", "LSB", "in/s", "dB", "m/s² peak"])
def test_units_that_are_not_read_are_refused(tmp_path: Path, unit: str) -> None:
    text = f"t_s,x ({unit}),y ({unit}),z ({unit})\n" + "\n".join(map(cells(T, *axes(MOTION)), range(COUNT)))
    with pytest.raises(InputError, match="unit that is not known"):
        read(tmp_path, text)


def test_channels_named_like_units_of_time_are_channels(tmp_path: Path) -> None:
    """North and south of a seismometer: NS is no time in nanoseconds."""
    rows = "\n".join(map(cells(T, *axes(MOTION)), range(COUNT)))
    assert right(read(tmp_path, f"t_s,NS,EW,UD\n{rows}", channels=["NS", "EW", "UD"]))


def test_a_resultant_alone_has_no_sign(tmp_path: Path) -> None:
    text = "Time (s),Absolute acceleration (m/s^2)\n" + "\n".join(map(cells(T, LENGTH), range(COUNT)))
    with pytest.raises(InputError, match="no sign"):
        read(tmp_path, text)


def test_a_few_rows_behind_a_gap_are_left_out_and_told(tmp_path: Path) -> None:
    text = text_of("phone, unnamed resultant") + "9.5,1,1,1,1.7\n"
    recording = read(tmp_path, text)
    assert right(recording) and any("has a gap before line 2402" in remark for remark in recording.remarks)


MUTANTS = 2000
JUNK = (b"--- pause ---", b"nan", b",,,,", b"0", b"Rate 500", b"# 500 Hz", b"\xff\xfe\x00", b"end", b"3 overruns", b"")


def mutant(rng: random.Random, content: bytes) -> bytes:
    """A file that an editor, a full disk, a cable or another program has spoilt in one place."""
    lines = content.split(b"\n")
    k = rng.choice([rng.randrange(len(lines)), rng.randrange(6), len(lines) - 1])
    line = lines[k]
    kind = rng.randrange(12)
    if kind == 0:
        lines.pop(k)
    elif kind == 1:
        lines.insert(k, line)
    elif kind == 2:
        lines[k], lines[-2] = lines[-2], line
    elif kind == 3:
        return content[: rng.randrange(len(content) // 2, len(content))]
    elif kind == 4:
        lines.insert(k, rng.choice(JUNK))
    elif kind == 5:
        return content.replace(b"\n", b"\r\n")
    elif kind == 6:
        parts = line.split(b",")
        parts[rng.randrange(len(parts))] = rng.choice([b"", b"nan", b"x", b"-", b"1e999", b"NULL"])
        lines[k] = b",".join(parts)
    elif kind < 9:
        place = rng.randrange(len(line) + 1)
        lines[k] = line[:place] + bytes([rng.randrange(256)]) + line[place + 1 :]
    else:
        before, after = [(b",", b";"), (b".", b","), (b",", b" , ")][kind - 9]
        lines[k] = line.replace(before, after)
    return b"\n".join(lines)


@pytest.mark.slow
def test_spoilt_files_are_refused_told_or_read_alike(tmp_path: Path) -> None:
    """Whatever is read without a new remark is within 0.1 dB; other errors than ours fail the test."""
    rng, whole = random.Random(1), {name: read(tmp_path, text_of(name)) for name in FILES}
    for number in range(MUTANTS):
        name = rng.choice(list(FILES))
        content = mutant(rng, text_of(name).encode())
        try:
            recording = read(tmp_path, content)
        except AbuError as error:
            assert error.remedy or error.place.line or error.found, (number, str(error))
            continue
        if set(recording.remarks) <= set(whole[name].remarks):
            pairs = zip(deviations(recording), deviations(whole[name]), strict=True)
            off = [abs(20 * math.log10(one / other)) for one, other in pairs]
            assert max(off) < 0.1 and recording.rate == pytest.approx(RATE, rel=0.01), (number, name)
