"""Samples of a recorded motion: what is refused, cut-off crests, and what column names mean."""

import hashlib

import numpy as np
import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.recording import LARGEST, chosen, flat_tops, recording

WAVE = np.sin(np.arange(200) / 7.3)


def test_a_recording_knows_its_length_and_its_file() -> None:
    made = recording("r.csv", b"bytes", "velocity", [("x", WAVE), ("y", 2 * WAVE)], 50.0, ["by hand"])
    assert (made.duration, made.names, made.remarks) == (4.0, ("x", "y"), ("by hand",))
    assert made.sha256 == hashlib.sha256(b"bytes").hexdigest()


@pytest.mark.parametrize(("axes", "words", "key"), [
    ([(name, WAVE) for name in "abcd"], "three axes", None), ([("a", WAVE), ("b", 0 * WAVE)], "same number", "b"),
    ([("a", 1.1 * LARGEST * WAVE)], "larger than anything", "a"),
])  # fmt: skip
def test_what_no_place_does_is_refused(axes: list[tuple[str, np.ndarray]], words: str, key: str | None) -> None:
    with pytest.raises(InputError, match=words) as refused:
        recording("r.csv", b"", "velocity", axes, 50.0)
    assert (refused.value.place.file, refused.value.place.key) == ("r.csv", key) and refused.value.remedy


def test_channels_are_chosen_by_name_or_number() -> None:
    """A name that looks like a number is a name."""
    assert chosen("f", ["x", "y", "z"], ["3", "x"]) == [2, 0]
    assert chosen("f", ["2", "1"], ["1", "2"]) == [1, 0]
    for asked, words in ((["0"], "no such"), (["4"], "no such"), (["w"], "no such"), (["x", "1"], "twice")):
        with pytest.raises(InputError, match=words):
            chosen("f", ["x", "y", "z"], asked)


def test_a_crest_that_is_cut_off_is_told_from_one_that_is_rounded() -> None:
    step = 0.01
    rounded = np.round(WAVE / step) * step
    assert flat_tops(rounded, step) is None
    cut = np.minimum(rounded, 0.5)
    assert flat_tops(cut, step) == int(np.flatnonzero(WAVE > 0.495)[0])
    assert flat_tops(np.maximum(rounded, -0.5), step) is not None


def test_axes_belong_to_their_handle() -> None:
    """Three axes at most at each handle, not in the file."""
    axes = [(name, WAVE) for name in "abcdef"]
    made = recording("r.csv", b"", "velocity", axes, 50.0, handles=["front"] * 3 + ["rear"] * 3)
    assert made.axes_by_handle == {"front": (0, 1, 2), "rear": (3, 4, 5)}
    assert recording("r.csv", b"", "velocity", axes[:2], 50.0).axes_by_handle == {"": (0, 1)}
    with pytest.raises(InputError, match="three axes") as refused:
        recording("r.csv", b"", "velocity", axes, 50.0, handles=["front"] * 4 + ["rear"] * 2)
    assert refused.value.place.key == "front" and refused.value.found == "a, b, c, d"
