"""Recorded files: what is read, and what is wrong with a file is told with its line and column."""

import io
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.io import wavfile

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.recording import Recording
from abu_calc.inputs.recording_files import read_recording

RATE = 1000.0
T = np.arange(1000) / RATE
WAVE = 3 * np.sin(2 * math.pi * 50 * T)
ROWS = [f"{t:.6f},{x:.6f}" for t, x in zip(T, WAVE, strict=True)]


def written(folder: Path, text: str | bytes, name: str = "r.csv") -> str:
    file = folder / name
    file.write_bytes(text.encode("utf-8") if isinstance(text, str) else text)
    return str(file)


def table(head: str, rows: list[str] = ROWS) -> str:
    return "\n".join([head, *rows]) + "\n"


def refused(file: str, **asked: object) -> InputError:
    with pytest.raises(InputError) as caught:
        read_recording(file, **asked)  # type: ignore[arg-type]
    assert caught.value.place.file == file or caught.value.place.key in ("quantity", "scale")
    return caught.value


def largest(found: Recording) -> float:
    return float(np.abs(found.samples[0]).max())


@pytest.mark.parametrize(("head", "quantity", "size"), [
    ("t_s,a_m_per_s2", "acceleration", 3.0), ("time [s],acc [m/s²]", "acceleration", 3.0),
    ("Time (s),Accel (m/s^2)", "acceleration", 3.0), ("t,ax [g]", "acceleration", 3 * 9.80665),
    ("t_s,vx_mm_per_s", "velocity", 3e-3), ("time,v [m/s]", "velocity", 3.0), ("t_s,x_um", "displacement", 3e-6),
    ("t_s,x_mm", "displacement", 3e-3), ("TIME [S],VEL [MM/S]", "velocity", 3e-3),
])  # fmt: skip
def test_names_tell_quantity_and_unit(tmp_path: Path, head: str, quantity: str, size: float) -> None:
    found = read_recording(written(tmp_path, table(head)))
    assert (found.quantity, found.rate) == (quantity, pytest.approx(RATE, rel=1e-9))
    assert largest(found) == pytest.approx(size, rel=1e-6) and not found.remarks


@pytest.mark.parametrize(("text", "told"), [
    (table("t,v"), "in m/s"), (table("t,signal"), "for an acceleration"), ("\n".join(ROWS), "for an acceleration"),
    (table("t;v [m/s]", [row.replace(",", ";").replace(".", ",") for row in ROWS]), "decimal points"),
    (table("t\tv [m/s]", [row.replace(",", "\t").replace(".", ",") for row in ROWS]), "decimal points"),
])  # fmt: skip
def test_what_is_taken_for_granted_is_told(tmp_path: Path, text: str, told: str) -> None:
    found = read_recording(written(tmp_path, text))
    assert largest(found) == pytest.approx(3.0, rel=1e-6)
    assert any(told in one for one in found.remarks)


@pytest.mark.parametrize("text", [
    table("# made by hand\nt_s,v [m/s]"), "\ufeff" + table("t_s,v [m/s]"), table("t_s,v [m/s]").replace("\n", "\r\n"),
    table("t,v\ns,m/s"), table("t;v [m/s]", [row.replace(",", ";") + ";" for row in ROWS]).replace("t;v", "t;v", 1)
    .replace("[m/s]", "[m/s];"), table("t v_m_per_s", [row.replace(",", "  ") for row in ROWS]),
    table('"t_s","v [m/s]"'), table("t_ms,v [m/s]", [f"{1000 * t:.3f},{x:.6f}" for t, x in zip(T, WAVE, strict=True)]),
    table("v [m/s],t_s", [",".join(reversed(row.split(","))) for row in ROWS]), table("t_s,v [m/s]") + "\n\n",
    table("t_s,v [m/s]", [f"{t:.9e},{x:.9e}" for t, x in zip(T, WAVE, strict=True)]),
    table("v [m/s],t_s", [f"{x + 1e-9:.9e},{t:.9e}" for t, x in zip(T, WAVE, strict=True)]),
])  # fmt: skip
def test_ways_of_writing_that_mean_the_same(tmp_path: Path, text: str) -> None:
    found = read_recording(written(tmp_path, text))
    assert (found.quantity, len(found.samples)) == ("velocity", 1)
    assert largest(found) == pytest.approx(3.0, rel=1e-6) and found.rate == pytest.approx(RATE, rel=1e-6)


def test_other_encodings(tmp_path: Path) -> None:
    for encoding in ("utf-16", "latin-1"):
        found = read_recording(written(tmp_path, table("t [s],v [µm/s]").encode(encoding)))
        assert largest(found) == pytest.approx(3e-6, rel=1e-6)


def changed(index: int, row: str) -> list[str]:
    return [*ROWS[:index], row, *ROWS[index + 1 :]]


@pytest.mark.parametrize(("rows", "line", "column", "word"), [
    (changed(500, "0.500000,nan"), 502, "v [m/s]", "not a number"),
    (changed(500, "0.500000,inf"), 502, "v [m/s]", "not a number"),
    (changed(500, "0.500000,"), 502, "v [m/s]", "found nothing"),
    (changed(500, "0.500000,over"), 502, "v [m/s]", "found over"),
    (changed(500, "nan,1.0"), 502, "t_s", "not a number"),
    (changed(500, "0.500000"), 502, None, "number of columns"),
    (changed(500, "0.500000,1.0,2.0"), 502, None, "number of columns"),
    (changed(500, "0,500000,1,0"), 502, None, "decimal points"),
    (changed(500, "0.499000,1.0"), 502, "t_s", "do not ascend"),
    (changed(500, "0.100000,1.0"), 502, "t_s", "do not ascend"),
    (changed(500, "0.500400,1.0"), 502, "t_s", "not equally spaced"),
    (ROWS[:500] + ROWS[520:], 502, "t_s", "a gap"), (ROWS[:500] + ROWS[501:], 502, "t_s", "a gap"),
    (ROWS[:2], None, None, "too few rows"), (["time,what"], 1, None, "no row of numbers"),
])  # fmt: skip
def test_wrong_rows_are_told_with_line_and_column(
    tmp_path: Path, rows: list[str], line: int | None, column: str | None, word: str
) -> None:
    error = refused(written(tmp_path, table("t_s,v [m/s]", rows)))
    assert (error.place.line, error.place.key) == (line, column), str(error)
    assert word in str(error)


@pytest.mark.parametrize(("text", "word"), [
    ("", "empty"), ("   \n\n", "empty"), (table("a_m_per_s2,v [m/s]"), "no column of time"),
    (table("t_s", [row.split(",")[0] for row in ROWS]), "no column beside the time"),
    (table("t_s,a [m/s²],v [m/s]", [row + ",1.0" for row in ROWS]), "several quantities"),
    (table("t_s,a,a,a,a", [row + "," + ",".join(row.split(",")[1:] * 3) for row in ROWS]), "three axes"),
    (table("t_s,a_m_per_s2", [f"{t:.4f},9.81" for t in T]), "same number"),
    (table("t;v [m/s]", [row.replace(",", ";").replace(".", ",", 1) for row in ROWS]), "both stand for decimals"),
    (table("t,signal,rpm", [row + ",1.0" + row[-1] for row in ROWS]), "not clear"),
    (table("t_s,v [m/s]", ["0,001,0,5", "0,002,0,6"]), "commas"),
    (b"\x00\x01\x02\x03" * 100, "neither a table"), (b"RIFF\x00\x00\x00\x00WAVE", "--scale"),
])  # fmt: skip
def test_wrong_files_are_refused(tmp_path: Path, text: str | bytes, word: str) -> None:
    assert word in str(refused(written(tmp_path, text)))


def test_what_is_asked_for_must_be_there(tmp_path: Path) -> None:
    file = written(tmp_path, table("t_s,ax [m/s²],ay [m/s²]", [row + ",1.0" + row[-1] for row in ROWS]))
    assert "no column of velocity" in str(refused(file, quantity="velocity"))
    assert "not a quantity" in str(refused(file, quantity="speed"))
    assert "not a scale" in str(refused(file, scale=-1.0))
    assert "no such channel" in str(refused(file, channels=["3"]))
    assert "twice" in str(refused(file, channels=["1", "ax [m/s²]"]))
    assert read_recording(file, channels=["ay [m/s²]"]).names == ("ay [m/s²]",)
    assert len(read_recording(file).samples) == 2
    assert largest(read_recording(file, scale=2.0, channels=["1"])) == pytest.approx(6.0, rel=1e-6)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    assert "cannot be read" in str(refused(str(tmp_path / "no.csv")))
    assert "cannot be read" in str(refused(str(tmp_path)))


def test_columns_that_others_stand_beside(tmp_path: Path) -> None:
    more = [f"{row},{k % 7},{20 + k / 1000}" for k, row in enumerate(ROWS)]
    assert read_recording(written(tmp_path, table("t_s,a [g],rpm,temperature", more))).names == ("a [g]",)
    plain = read_recording(written(tmp_path, table("time,x,y,z", more)), "acceleration")
    assert (plain.names, plain.quantity) == (("x", "y", "z"), "acceleration")
    assert read_recording(written(tmp_path, table("time,signal,rpm,n", more)), channels=["signal"]).names == ("signal",)


def test_times_that_are_only_rounded_are_equally_spaced(tmp_path: Path) -> None:
    """A rate of 3 kHz in steps of 0.1 ms: 3, 3, 4 of them; the rate is that of the whole file."""
    rows = [f"{k / 3000:.4f},{x:.6f}" for k, x in enumerate(WAVE)]
    found = read_recording(written(tmp_path, table("t_s,v [m/s]", rows)))
    assert found.rate == pytest.approx(3000, rel=1e-3)
    jittered = [f"{k / 3000 + 2e-4 * (k % 3 == 1):.4f},{x:.6f}" for k, x in enumerate(WAVE)]
    assert "not equally spaced" in str(refused(written(tmp_path, table("t_s,v [m/s]", jittered))))


def test_russian_windows(tmp_path: Path) -> None:
    rows = [row.replace(",", ";").replace(".", ",") for row in ROWS]
    found = read_recording(written(tmp_path, table("Время [с];Виброскорость [мм/с]", rows).encode("cp1251")))
    assert found.quantity == "velocity" and largest(found) == pytest.approx(3e-3, rel=1e-6)


# voltages and handles
def six(head: str) -> str:
    """Axis k of six has k times the wave."""
    rows = [",".join([f"{t:.6f}", *(f"{k * x:.9f}" for k in range(1, 7))]) for t, x in zip(T, WAVE, strict=True)]
    return table(head, rows)


FRONT_REAR = "t_s," + ",".join(f"{handle}_a{axis}_mV" for handle in ("front", "rear") for axis in "xyz")


def test_a_voltage_is_turned_into_motion_by_its_own_sensitivity(tmp_path: Path) -> None:
    """k times 3 mV, at 10 mV per m/s² k·0.3 m/s², at 100 mV/g k·0.03 g."""
    file = written(tmp_path, six(FRONT_REAR))
    found = read_recording(file, sensitivity=[10.0, "rear_az_mV=100 mV/g", "2=20"])
    assert found.quantity == "acceleration" and found.axes_by_handle == {"front": (0, 1, 2), "rear": (3, 4, 5)}
    tops = [float(np.abs(values).max()) for values in found.samples]
    assert tops == pytest.approx([0.3, 0.3, 0.9, 1.2, 1.5, 0.18 * 9.80665], rel=1e-6)
    assert "Sensitivity 10 mV per m/s²: front_ax_mV, front_az_mV, rear_ax_mV, rear_ay_mV." in found.remarks
    velocity = read_recording(written(tmp_path, table("t_s,x [V]")), sensitivity="20 mV/(mm/s)")
    assert velocity.quantity == "velocity" and largest(velocity) == pytest.approx(0.150, rel=1e-6)


@pytest.mark.parametrize(("head", "asked", "key", "word"), [
    ("t_s,ax_mV", {}, "ax_mV", "without the sensitivity"), ("t_s,a [V]", {}, "a [V]", "without the sensitivity"),
    ("t_s,ax_mV", {"sensitivity": "ay_mV=10"}, "ax_mV", "without the sensitivity"),
    ("t_s,ax_mV", {"sensitivity": [10.0, "ay_mV=10"]}, "sensitivity", "without use"),
    ("t_s,ax_m_per_s2", {"sensitivity": 10.0}, "sensitivity", "without use"),
    ("t_s,ax_m_per_s2", {"sensitivity": "1=10"}, "ax_m_per_s2", "not in V or mV"),
    ("t_s,ax", {"sensitivity": "ax=10"}, "ax", "not in V or mV"),
    ("t_s,ax_mV", {"sensitivity": "20 mV/(mm/s)"}, None, "several quantities"),
    ("t_s,ax_mV", {"sensitivity": 10.0, "scale": 2.0}, "sensitivity", "both"),
    ("t_s,ax_mV", {"sensitivity": 10.0, "full_scale_mV": 5.0}, "full_scale_mV", "no WAV"),
    ("t_s,ax_mV", {"sensitivity": 10.0, "quantity": "velocity"}, None, "several quantities"),
])  # fmt: skip
def test_voltages_that_cannot_be_motion_are_refused(
    tmp_path: Path, head: str, asked: dict[str, object], key: str | None, word: str
) -> None:
    with pytest.raises(InputError) as refusal:
        read_recording(written(tmp_path, table(head)), **asked)  # type: ignore[arg-type]
    assert word in str(refusal.value) and refusal.value.place.key == key


def test_a_scale_takes_the_place_of_a_sensitivity(tmp_path: Path) -> None:
    assert largest(read_recording(written(tmp_path, table("t_s,ax_mV")), scale=0.1)) == pytest.approx(0.3, rel=1e-6)


def test_handles_by_channels(tmp_path: Path) -> None:
    file = written(tmp_path, six("t_s," + ",".join(f"CH{k} [m/s²]" for k in range(1, 7))))
    found = read_recording(file, handles={"rear": ["4", "5", "6"], "front": ["CH1 [m/s²]", "2"]})
    assert found.axes_by_handle == {"rear": (0, 1, 2), "front": (3, 4)}
    assert [round(float(np.abs(values).max())) for values in found.samples] == [12, 15, 18, 3, 6]
    assert "--handle" in str(refused(file))


@pytest.mark.parametrize(("asked", "word"), [
    ({"handles": {"front": ["1"]}, "channels": ["2"]}, "both channels and handles"),
    ({"handles": {"": ["1"]}}, "needs a name"),
    ({"handles": {"front": []}}, "needs a name"), ({"handles": {"front": ["1"], "rear": ["1"]}}, "twice"),
    ({"handles": {"front": ["7"]}}, "no such channel"), ({"handles": {"front": ["1", "2", "3", "4"]}}, "three axes"),
])  # fmt: skip
def test_handles_that_cannot_be_are_refused(tmp_path: Path, asked: dict[str, object], word: str) -> None:
    file = written(tmp_path, six("t_s," + ",".join(f"CH{k} [m/s²]" for k in range(1, 7))))
    with pytest.raises(InputError, match=word):
        read_recording(file, **asked)  # type: ignore[arg-type]


def test_two_columns_without_axes_are_told_to_be_one_place(tmp_path: Path) -> None:
    file = written(tmp_path, table("t_s,front [m/s²],rear [m/s²]", [row + "," + row.split(",")[1] for row in ROWS]))
    assert any("axes of one place" in remark for remark in read_recording(file).remarks)


def test_a_column_that_names_no_handle_beside_others_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path, six(FRONT_REAR.replace("rear_az_mV", "az_mV")))
    assert "without the name of a handle" in str(refused(file, sensitivity=10.0))


# WAV
def wav(values: np.ndarray, rate: int = 8000) -> bytes:
    buffer = io.BytesIO()
    wavfile.write(buffer, rate, values)
    return buffer.getvalue()


TONE = 0.5 * np.sin(2 * math.pi * 63 * np.arange(8000) / 8000)


@pytest.mark.parametrize(("kind", "full"), [("int16", 2**15), ("int32", 2**31), ("float32", 1), ("float64", 1)])
def test_samples_of_every_kind_are_shares_of_full_scale(tmp_path: Path, kind: str, full: float) -> None:
    file = written(tmp_path, wav((TONE * full).astype(kind)), "r.wav")
    found = read_recording(file, "velocity", 0.2)
    assert largest(found) == pytest.approx(0.1, rel=1e-4) and found.rate == 8000
    assert found.samples[0] == pytest.approx(0.2 * TONE, abs=2e-5)


def test_samples_of_8_bits_have_their_zero_at_128(tmp_path: Path) -> None:
    file = written(tmp_path, wav((128 + 127 * TONE).astype("uint8")), "r.wav")
    assert read_recording(file, scale=1.0).samples[0] == pytest.approx(TONE * 127 / 128, abs=1 / 128)


def test_samples_of_24_bits(tmp_path: Path) -> None:
    """As the format has it: three bytes a sample, a header of 44 bytes."""
    whole = (TONE * 2**23).astype("<i4")
    data = whole.view("u1").reshape(-1, 4)[:, :3].tobytes()
    head = b"RIFF" + (36 + len(data)).to_bytes(4, "little") + b"WAVEfmt " + (16).to_bytes(4, "little")
    head += (1).to_bytes(2, "little") + (1).to_bytes(2, "little") + (8000).to_bytes(4, "little")
    head += (24000).to_bytes(4, "little") + (3).to_bytes(2, "little") + (24).to_bytes(2, "little")
    file = written(tmp_path, head + b"data" + len(data).to_bytes(4, "little") + data, "r.wav")
    assert read_recording(file, scale=1.0).samples[0] == pytest.approx(TONE, abs=1e-6)


@pytest.mark.parametrize("lengths", [(0xFFFFFFFF, 0xFFFFFFFF), (0, 0), (0x7FFFF024, 0x7FFFF000)])
def test_a_streamed_wav_is_read_to_its_end(tmp_path: Path, lengths: tuple[int, int]) -> None:
    """A program that writes to a pipe, as FFmpeg, or SoX, leaves both lengths open; half a frame at the end is cut."""
    whole = wav(np.stack([TONE, TONE / 2], axis=1).astype("float32"))
    place = whole.index(b"data") + 4
    riff, data = (length.to_bytes(4, "little") for length in lengths)
    open_ended = whole[:4] + riff + whole[8:place] + data + whole[place + 4 :] + b"\1\2\3"
    found = read_recording(written(tmp_path, open_ended, "r.wav"), scale=1.0)
    assert found.samples[1] == pytest.approx(TONE / 2, abs=1e-6) and len(found.samples[0]) == 8000
    assert any("leaves its length open" in remark for remark in found.remarks)
    cut_off = whole[:-400]
    assert "not a WAV file that can be read" in str(refused(written(tmp_path, cut_off, "cut.wav"), scale=1.0))


@pytest.mark.parametrize("name", ["\0", "a\0.csv", "a\0.wav"])
def test_a_name_that_no_file_can_have_is_refused(name: str) -> None:
    assert "not a file name" in str(refused(name))


def test_channels_of_a_wav_are_axes(tmp_path: Path) -> None:
    both = written(tmp_path, wav(np.stack([TONE, TONE / 2], axis=1).astype("float32")), "r.wav")
    found = read_recording(both, "acceleration", 10.0)
    assert found.names == ("channel 1", "channel 2") and any("axes" in one for one in found.remarks)
    assert read_recording(both, "acceleration", 10.0, ["2"]).names == ("channel 2",)
    four = written(tmp_path, wav(np.stack([TONE] * 4, axis=1).astype("float32")), "four.wav")
    assert "three axes" in str(refused(four, scale=1.0))


def test_a_wav_in_volts_has_a_sensitivity_for_each_channel(tmp_path: Path) -> None:
    """Half of 5000 mV, at 10 and 20 mV per m/s²."""
    file = written(tmp_path, wav(np.stack([TONE] * 4, axis=1).astype("float32")), "r.wav")
    handles = {"front": ["1", "2"], "rear": ["3", "4"]}
    found = read_recording(file, sensitivity=[10, "channel 4=20"], full_scale_mV=5000, handles=handles)  # type: ignore[list-item]
    tops = [float(np.abs(values).max()) for values in found.samples]
    assert tops == pytest.approx([250, 250, 250, 125], rel=1e-3) and list(found.axes_by_handle) == ["front", "rear"]
    for numbers, expected in ((["1=10", "2=20"], [250, 125]), (["2=20", 10], [250, 125]), (["1=5", 10], [500, 250])):
        by_number = read_recording(file, sensitivity=numbers, full_scale_mV=5000, channels=["1", "2"])  # type: ignore[arg-type]
        assert [float(np.abs(values).max()) for values in by_number.samples] == pytest.approx(expected, rel=1e-3)
    for asked in ({"sensitivity": 10.0}, {"full_scale_mV": 5000.0}, {"scale": 1.0, "full_scale_mV": 5.0}):
        with pytest.raises(InputError):
            read_recording(file, channels=["1"], **asked)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["int16", "int32", "float32", "uint8"])
def test_clipped_recordings_are_refused(tmp_path: Path, kind: str) -> None:
    loud = np.clip(3 * TONE, -1, 1)
    full = {"int16": 32767, "int32": 2**31 - 1, "float32": 1.0, "uint8": 127}[kind]
    values = (128 + full * loud if kind == "uint8" else full * loud).astype(kind)
    error = refused(written(tmp_path, wav(values), "r.wav"), scale=1.0)
    assert "clipped" in str(error) and error.place.key == "channel 1"


@pytest.mark.parametrize("hertz", [8, 63, 1000])
def test_a_sine_up_to_full_scale_is_not_clipped(tmp_path: Path, hertz: int) -> None:
    """Its crest is round: some samples of whole numbers are alike there, and those beside them fall off slowly."""
    tone = (32767 * np.sin(2 * math.pi * hertz * np.arange(48000) / 48000)).round().astype("int16")
    assert largest(read_recording(written(tmp_path, wav(tone, 48000), "r.wav"), scale=1.0)) > 0.999


def test_a_table_that_is_cut_off_is_told(tmp_path: Path) -> None:
    rows = [f"{t:.4f},{x:.5f}" for t, x in zip(T, np.clip(WAVE, -2, 2), strict=True)]
    assert any("clipped" in one for one in read_recording(written(tmp_path, table("t_s,v [m/s]", rows))).remarks)


@pytest.mark.parametrize("content", [b"RIFF", b"RIFF1234WAVEjunk", wav(TONE.astype("float32"))[:300], b"not a wav"])
def test_broken_wavs_are_refused(tmp_path: Path, content: bytes) -> None:
    error = refused(written(tmp_path, content, "r.wav"), scale=1.0)
    assert "WAV" in str(error) and "bug" not in str(error)
