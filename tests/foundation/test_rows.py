"""Tables of results: rows, columns, and round trips through libraries of tables where they are installed."""

import math
import pickle
import subprocess
import sys

import pytest

from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import InputError, OutputError
from abu_calc.foundation.quantity import Record, record
from abu_calc.foundation.rows import Columns, Rows, as_rows


@record
class Inner(Record):
    low: float
    high: float | None


@record
class Outer(Record):
    name: str
    ball_count: int
    level_db: float | None
    balances: bool
    band: Inner
    angles_deg: tuple[float, ...]


ROWS = Rows(
    (
        Outer(name="a, „quoted“", ball_count=3, level_db=98.7, balances=True, band=Inner(low=1.0, high=None),
              angles_deg=(1.0, 2.0)),
        Outer(name="b", ball_count=4, level_db=None, balances=False, band=Inner(low=2.0, high=5.0), angles_deg=()),
    )
)  # fmt: skip
COLUMNS = {
    "name": ["a, „quoted“", "b"],
    "ball_count": [3, 4],
    "level_db": [98.7, None],
    "balances": [True, False],
    "band.low": [1.0, 2.0],
    "band.high": [None, 5.0],
    "angles_deg": [[1.0, 2.0], []],
}


def test_they_are_records_in_their_order_and_columns() -> None:
    assert [row.name for row in ROWS] == ["a, „quoted“", "b"] and ROWS[1].ball_count == 4 and len(ROWS[:1]) == 1
    assert ROWS.to_dict("list") == ROWS.to_dict() == COLUMNS
    assert ROWS.to_dict("records") == ROWS.rows
    assert ROWS.rows[1]["band.high"] == 5.0
    with pytest.raises(InputError, match="not a form of a table"):
        ROWS.to_dict("rows")  # type: ignore[arg-type]


def test_they_equal_a_tuple_and_survive_pickling() -> None:
    assert tuple(ROWS) == ROWS and tuple(ROWS) == ROWS and hash(ROWS) == hash(tuple(ROWS)) and ROWS != []
    assert pickle.loads(pickle.dumps(ROWS)) == ROWS
    assert (*ROWS, 1)[2] == 1 and ROWS.index(ROWS[1]) == 1 and ROWS.count(ROWS[0]) == 1 and ROWS[1] in ROWS
    one = (1,)
    assert (ROWS + one)[2] == 1 and (one + ROWS)[0] == 1
    assert repr(ROWS) == "<2 × Outer>" and repr(Rows()) == "<0 × row>"


def test_a_tuple_of_a_record_is_a_table_others_are_left_alone() -> None:
    assert isinstance(as_rows(tuple(ROWS)), Rows)
    assert as_rows((1.0, 2.0)) == (1.0, 2.0) and as_rows(()) == () and as_rows([1]) == [1]


def test_html_escapes() -> None:
    check = Check("ABU201", "<script>", "pass", "&", 1.0)
    html = Rows((check,) * 30)._repr_html_()
    assert "<script>" not in html and "&lt;script&gt;" in html and "and 10 more" in html


@pytest.mark.slow
def test_pandas_round_trip() -> None:
    pandas = pytest.importorskip("pandas")
    frame = ROWS.to_pandas()
    assert list(frame.columns) == list(COLUMNS) and frame["ball_count"].tolist() == [3, 4]
    assert math.isnan(frame["level_db"][1]) and frame["angles_deg"][0] == [1.0, 2.0]
    assert pandas.DataFrame(ROWS.rows).equals(frame)
    assert pandas.DataFrame(ROWS)["name"].tolist() == COLUMNS["name"]


@pytest.mark.slow
def test_polars_round_trip() -> None:
    polars = pytest.importorskip("polars")
    for frame in (polars.DataFrame(ROWS), polars.from_dataframe(ROWS)):
        assert frame["level_db"].to_list() == [98.7, None] and frame["name"].to_list() == COLUMNS["name"]
        assert frame["balances"].to_list() == [True, False] and frame["ball_count"].dtype == polars.Int64
        assert frame["angles_deg"].to_list() == ["[1.0, 2.0]", "[]"]


def test_pyarrow_and_pandas_by_arrow() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(ROWS)
    table.validate(full=True)
    assert table.column("band.high").to_pylist() == [None, 5.0]
    pandas = pytest.importorskip("pandas")
    frame = pandas.api.interchange.from_dataframe(ROWS)
    assert frame["ball_count"].tolist() == [3, 4]


def test_columns_of_all_kinds_and_lengths() -> None:
    polars = pytest.importorskip("polars")

    class Table(Columns):
        def __init__(self, columns: dict[str, list[object]]) -> None:
            self._given = columns

        @property
        def columns(self) -> dict[str, list[object]]:
            return self._given

    for length in (0, 1, 7, 8, 9, 1000):
        columns: dict[str, list[object]] = {
            "bool": [k % 3 == 0 if k % 5 else None for k in range(length)],
            "int": [k * 2**40 if k % 4 else None for k in range(length)],
            "float": [k / 7 if k % 6 else None for k in range(length)],
            "text": ["ü" * (k % 4) if k % 7 else None for k in range(length)],
            "none": [None] * length,
        }
        frame = polars.DataFrame(Table(columns))
        assert frame.shape == (length, 5)
        assert all(frame[name].to_list() == values for name, values in columns.items())
    odd = polars.DataFrame(Table({"nan": [1.0, float("nan")], "mixed": [1, "a"], "numbers": [1, 2.5]}))
    assert odd["nan"].to_list() == [1.0, None] and odd["mixed"].to_list() == ["1", "a"]
    assert odd["numbers"].to_list() == [1.0, 2.5]


def test_without_a_library_the_remedy_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    for library in ("pyarrow", "polars", "pandas"):
        monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(OutputError, match="pip install polars"):
        ROWS.__arrow_c_stream__()
    with pytest.raises(OutputError, match="pip install pandas"):
        ROWS.to_pandas()


def test_no_library_is_imported() -> None:
    code = (
        "import sys, abu_calc\nfrom abu_calc.foundation.rows import Rows\nRows().to_dict()\n"
        "print({'pandas', 'polars', 'xarray', 'pyarrow', 'ctypes'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"
