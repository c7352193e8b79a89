"""Recorded runs: amplitude and phase from time, two sensors and a mark.

Passages of a mark whose times are known by construction.
"""

import math
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.balancing.recorded_run import (
    RecordedRun,
    RigRecord,
    passages,
    read_rig_record,
    recorded_run,
    smooth,
)
from abu_calc.foundation.errors import InputError
from tests.features.balancing.rig import DAMPING, RIG, ROTOR, Simulated, Workshop, csv, recorded, turned, written

LEFT, RIGHT = (0.038, 200.0), (0.0316, -152.0)
SPEED = 2 * math.pi * 49.3
PULSE = 0.12
SHAPES = {
    "square from the mark on": lambda angle: (angle % math.tau < PULSE) * 1.0,
    "rounded about the mark": lambda angle: np.exp(-(((angle + math.pi) % math.tau - math.pi) ** 2) / 0.01),
    "a third of a revolution": lambda angle: (angle % math.tau < 2.1) * 1.0,
    "one sample": lambda angle: np.concatenate([[0.0], (np.diff(angle % math.tau) < 0) * 1.0]),
}


def made(
    shape: str = "square from the mark on", *, sign: float = 1.0, drift: float = 0.0, noise: float = 0.0,
    seconds: float = 1.1, rate: float = 10_000.0, start: float = 1.3, wander: float = 0.0,
) -> RigRecord:  # fmt: skip
    """A record with offsets that drift, a harmonic, a stranger at 21 Hz, and parts of revolutions at both ends."""
    rng = np.random.default_rng(3)
    t = np.arange(0, seconds, 1 / rate)
    angle = start + SPEED * t * (1 + drift * (t / seconds - 1) / 2) + wander * np.sin(5 * t)
    sides = [
        A * np.cos(angle - math.radians(phase)) + offset + 0.02 * t + 0.1 * A * np.cos(2 * angle + 1)
        + 0.1 * A * np.cos(131.9 * t) + noise * A * rng.standard_normal(t.size)
        for (A, phase), offset in ((LEFT, 0.3), (RIGHT, -2.0))
    ]  # fmt: skip
    mark = 2.5 + sign * (5 * SHAPES[shape](angle) + 0.05 * (noise > 0) * rng.standard_normal(t.size))
    return RigRecord(t, sides[0], sides[1], mark)


def holds(found: RecordedRun) -> None:
    """Within 0.5 % and 0.5°."""
    for tone, (amplitude, phase) in ((found.left, LEFT), (found.right, RIGHT)):
        assert tone.amplitude == pytest.approx(amplitude, rel=0.005)
        assert abs(turned(math.degrees(tone.phase), phase)) < 0.5


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    "spoilt",
    [{}, {"drift": 0.04}, {"drift": -0.02, "noise": 0.1}, {"noise": 0.2, "start": 5.9}, {"wander": 0.05}],
    ids=str,
)
def test_a_record_gives_the_readings_it_was_made_of(shape: str, sign: float, spoilt: dict[str, float]) -> None:
    holds(recorded_run(made(shape, sign=sign, **spoilt)))


def test_what_of_a_pulse_counts_is_told() -> None:
    square, about = made(), made("rounded about the mark")
    assert recorded_run(square).marks.edge == "leading" and recorded_run(about).marks.edge == "middle"
    turns = [math.degrees(recorded_run(square, edge).left.phase) for edge in ("leading", "middle", "trailing")]
    assert turned(turns[0], turns[1]) == pytest.approx(math.degrees(PULSE) / 2, abs=0.2)
    assert turned(turns[0], turns[2]) == pytest.approx(math.degrees(PULSE), abs=0.3)


def test_a_missed_mark_does_no_harm() -> None:
    record = made()
    passed = np.flatnonzero(np.diff(record.mark) > 2.0)
    mark = record.mark.copy()
    mark[passed[20] - 3 : passed[20] + 60] = mark.min()
    holds(recorded_run(RigRecord(record.time, record.left, record.right, mark)))


def test_uneven_samples_do_no_harm() -> None:
    record = made(rate=30_000.0)
    kept = np.random.default_rng(2).random(record.time.size) < 0.6
    holds(recorded_run(RigRecord(*(column[kept] for column in vars(record).values()))))


@pytest.mark.parametrize("first", [0.0, 0.7])
def test_sampling_in_step_with_the_rotation(first: float) -> None:
    """200 samples a revolution: a record that the mark started has it on a sample; else it is sure to half of one."""
    t = np.arange(0, 1, 1e-4)
    angle = np.round(math.tau * 50 * t, 12) + first
    record = RigRecord(t, np.cos(angle - 1), np.cos(angle + 2), (angle % math.tau < 0.2) * 1.0)
    found = recorded_run(record)
    off = abs(turned(math.degrees(found.left.phase), math.degrees(1)))
    assert off < 0.05 if first == 0 else off < math.degrees(found.unsure) + 1e-9 < 0.91


def refused(record: RigRecord, **how: float) -> str:
    with pytest.raises(InputError) as error:
        recorded_run(record, **how)  # type: ignore[arg-type]
    return str(error.value)


def with_mark(mark: np.ndarray) -> RigRecord:
    record = made()
    return RigRecord(record.time, record.left, record.right, mark)


def test_records_that_tell_nothing_are_refused() -> None:
    record = made()
    t, rng = record.time, np.random.default_rng(1)
    assert "no pulses" in refused(with_mark(np.zeros_like(t)))
    assert "noise" in refused(with_mark(rng.random(t.size) + 1.2 * (t * 49.3 % 1 < 0.02)))
    turn = t * 49.3 % 1
    assert "both sides" in refused(with_mark((turn < 0.02) * 1.0 - (turn > 0.98) * 1.0))
    assert "as long up as down" in refused(with_mark((turn < 0.5) * 1.0))
    assert "too few revolutions" in refused(made(seconds=0.05))
    assert "too few samples" in refused(made("a third of a revolution", rate=300.0))
    uneven = np.where((t * 24.65 % 1 < 0.02) | (np.abs(t * 24.65 % 1 - 0.35) < 0.01), 1.0, 0.0)
    assert "once a revolution" in refused(with_mark(uneven))
    twice = with_mark((t * 98.6 % 1 < 0.05) * 1.0)
    assert "2 pulses a revolution" in refused(twice, speed=SPEED)
    assert "not steady" in refused(made(drift=0.5))
    assert recorded_run(record, speed=SPEED * 1.01).revolutions == 53


# Files


@pytest.mark.slow
def test_a_simulated_run_goes_the_whole_way(tmp_path: Path) -> None:
    """Integrated in time with a drifting speed, noise, offsets; by displacement and by acceleration."""
    shop = Workshop(Simulated(damping=DAMPING), sensor_deg=40.0)
    t, places, angle = recorded(shop, drift=0.01)
    rng = np.random.default_rng(4)
    noisy = 1e3 * places * (1 + 0.0) + 0.002 * rng.standard_normal(places.shape)
    mark = 0.2 - 4.0 * (angle % math.tau < 0.1)
    csv(tmp_path, {"time": t, "left": noisy[:, 0] + 0.5, "right": noisy[:, 1] - 0.2, "mark": mark})
    run = '[[run]]\nquantity = "displacement"\nfile = "run1.csv"\nsensor_to_mark_deg = 40.0\n'
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, run))
    (found,) = result.runs
    for reading, (amplitude, phase) in zip((found.left, found.right), shop.read(), strict=True):
        assert reading.amplitude == pytest.approx(amplitude, rel=0.005)
        assert abs(turned(reading.phase_deg, phase)) < 0.5
    assert (
        found.speed_rpm == pytest.approx(3000, rel=1e-3) and found.revolutions == 59 and len(found.sha256 or "") == 64
    )
    assert (result.left.mass_g, result.right.mass_g) == pytest.approx((12.0, 7.0), rel=0.02)
    assert abs(turned(result.left.angle_deg, 205)) < 1.5 and abs(turned(result.right.angle_deg, 320)) < 1.5
    assert any("lasts 5." in line for line in result.warnings)


@pytest.mark.slow
def test_a_noisy_record_makes_the_answer_less_sure(tmp_path: Path) -> None:
    """Its noise counts beside [errors]; half of the motion's size over 16 000 samples, without other errors."""
    shop = Workshop()
    t = np.arange(0, 1.6, 1e-4)
    angle = shop.speed * 1.001 * t + 0.3
    rng = np.random.default_rng(9)
    sides = [A * np.cos(angle - math.radians(phase)) for A, phase in shop.read()]
    noise = [0.5 * np.abs(side).max() * rng.standard_normal(t.size) for side in sides]
    run = '[[run]]\nquantity = "displacement"\nfile = "run1.csv"\n'
    errors = "[errors]\n" + "\n".join(
        f"{key} = 0" for key in ("amplitude_percent", "phase_deg", "speed_percent", "support_mass_percent",
                                 "stiffness_percent", "damping_ratio", "rotor_mass_percent", "inertia_percent",
                                 "length_mm", "placed_mass_percent", "placed_angle_deg")
    )  # fmt: skip
    found = []
    for share in (0.0, 1.0):
        columns = {"left": sides[0] + share * noise[0], "right": sides[1] + share * noise[1]}
        csv(tmp_path, {"time": t, **columns, "mark": (angle % math.tau < 0.1) * 1.0})
        found.append(abu_calc.balance(written(tmp_path, RIG, ROTOR, run, errors)).left.mass_uncertainty_g)
    assert found[0] < 1e-3 * 12
    assert found[1] == pytest.approx(12 * 0.5 * math.sqrt(2 / t.size), rel=0.25)


@pytest.mark.parametrize(
    ("header", "sign", "comma"),
    [("time,left,right,mark", ",", False), ("mark;right;left;t_s", ";", True), ("", "\t", False), ("", " ", False),
     ('"Time (ms)","Left","Right","Mark"', ",", False)],
)  # fmt: skip
def test_records_of_many_hands(tmp_path: Path, header: str, sign: str, comma: bool) -> None:
    columns = {"t": [0.001, 0.002, 0.003], "left": [1.5, 2, 3], "right": [4, 5, 6], "mark": [0, 1, 0]}
    order = [name.strip('"').split("_")[0].lower().split(" ")[0][:4] for name in header.split(sign)] if header else []
    names = [next(key for key in columns if key.startswith(name[:1])) for name in order] or list(columns)
    scale = {"t": 1e3} if "ms" in header else {}
    rows = [[f"{columns[name][k] * scale.get(name, 1):.9g}" for name in names] for k in range(3)]
    body = "\n".join(sign.join(row) for row in rows)
    path = tmp_path / "run.csv"
    path.write_text("# a comment\n" + (header + "\n" if header else "") + (body.replace(".", ",") if comma else body))
    found = read_rig_record(path)
    assert list(found.time) == pytest.approx([0.001, 0.002, 0.003])
    assert list(found.left) == [1.5, 2, 3] and list(found.right) == [4, 5, 6] and list(found.mark) == [0, 1, 0]


@pytest.mark.parametrize(
    ("text", "part", "line"),
    [
        ("", "empty", None),
        ("time,left,right\n1,2,3\n", "too few columns", 1),
        ("time,left,left,mark\n1,2,3,4\n", "told apart", 1),
        ("time,left,right,mark\n", "no row of numbers", 1),
        ("0,1,2,3\n1,2,x,4\n", "not a number", 2),
        ("0,1,2,3\n1,2,3\n2,3,4,5\n", "number of columns", 2),
        ("0,1,2,3\n1,2,nan,4\n", "not a number", 2),
        ("0,1,2,3\n1,2,3,4\n1,2,3,4\n", "does not go on", 3),
    ],
)
def test_wrong_records_are_refused_with_their_line(tmp_path: Path, text: str, part: str, line: int | None) -> None:
    path = tmp_path / "run.csv"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        read_rig_record(path)
    assert part in str(error.value) and error.value.place.line == line and error.value.place.file == str(path)


def test_time_that_goes_back_is_told_with_the_time_before_it(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("time,left,right,mark\n5,1,2,3\n6,1,2,3\n8,1,2,3\n7,1,2,3\n9,1,2,3\n")
    with pytest.raises(InputError, match="time does not go on") as error:
        read_rig_record(path)
    assert (error.value.place.line, error.value.found) == (5, "7 after 8")


RATE, TURN, WIDTH, FIRST = 10_000.0, 0.02037, 0.00105, 0.0049
TIME = np.arange(0, 1, 1 / RATE)


def pulses(sign: float = 1.0, width: float = WIDTH) -> np.ndarray:
    return 2.0 + sign * 5.0 * ((width > (TIME - FIRST) % TURN) & (TIME >= FIRST))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_square_pulses_pass_by_their_leading_edge(sign: float) -> None:
    marks = passages(TIME, pulses(sign))
    true = FIRST + TURN * np.arange(len(marks.times))
    assert marks.edge == "leading" and marks.square and marks.step == pytest.approx(1 / RATE)
    assert len(marks.times) in (48, 49)  # (1 − 0.0049)/0.02037 = 48.9; a pulse that is cut off does not count
    assert np.abs(marks.times - true).max() < 0.2 / RATE  # finer than a sample, by all edges together
    assert marks.width == pytest.approx(WIDTH, abs=1 / RATE)


def test_the_edges_of_a_pulse_lie_its_width_apart() -> None:
    leading, middle, trailing = (passages(TIME, pulses(), edge).times for edge in ("leading", "middle", "trailing"))
    assert trailing - leading == pytest.approx(WIDTH, abs=0.5 / RATE)
    assert middle == pytest.approx((leading + trailing) / 2)


def test_a_rounded_pulse_passes_by_its_middle() -> None:
    away = (TIME - FIRST + TURN / 2) % TURN - TURN / 2
    marks = passages(TIME, np.exp(-((away / 0.0008) ** 2)))
    assert marks.edge == "middle" and not marks.square
    true = FIRST + TURN * np.arange(len(marks.times))
    assert np.abs(marks.times - true).max() < 0.05 / RATE


def test_a_polynomial_course_of_times_is_left_as_it_is() -> None:
    """A speed that falls evenly: times are no straight line, and scatter of 1e-4 falls below a third of itself."""
    counts = np.arange(60)
    true = 0.02 * counts + 3e-5 * counts**2
    assert smooth(true) == pytest.approx(true, abs=1e-9)
    noise = 1e-4 * np.random.default_rng(1).standard_normal(60)
    assert np.std(smooth(true + noise) - true) < np.std(noise) / 3


@pytest.mark.parametrize(
    ("mark", "part"),
    [
        (np.full_like(TIME, 3.0), "no pulses"),
        (pulses(width=TURN / 2), "as long up as down"),
        ((np.abs(TIME - 0.5) < 0.01) * 1.0, "a single one"),
    ],
)
def test_marks_without_passages_are_refused(mark: np.ndarray, part: str) -> None:
    with pytest.raises(InputError, match=part):
        passages(TIME, mark)
