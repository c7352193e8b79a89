"""Kinds of files, by their tables."""

from pathlib import Path

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.document import open_document
from abu_calc.inputs.reading.kinds import BY_NAME, KINDS, Kind, kind_of, refuse_others
from tests.inputs.scenes import SCENE


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_a_kind_is_known_by_each_of_its_tables(kind: Kind) -> None:
    for mark in kind.marks:
        assert kind_of({mark: {}, "other": {}}) is kind
    assert set(kind.marks) <= kind.model.model_fields.keys() and kind.model in kind.all_models()


def test_no_table_marks_two_kinds_and_the_first_of_several_counts() -> None:
    marks = [mark for kind in KINDS for mark in kind.marks]
    assert len(marks) == len(set(marks)) and len(BY_NAME) == len(KINDS)
    assert kind_of(dict.fromkeys(reversed(marks))) is KINDS[0]
    assert kind_of({"unknown": {}}) is KINDS[0]


def test_a_good_file_of_another_kind_is_refused_with_the_command_that_takes_it(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    document = open_document(str(file))
    refuse_others(document, "scene")
    refuse_others(document, "machine", "scene")
    with pytest.raises(InputError, match="holds a scene, not a machine") as refused:
        refuse_others(document, "machine")
    assert (refused.value.place.file, refused.value.place.key) == (str(file), "scene")
    assert refused.value.remedy == "`abu simulate FILE` takes it"
