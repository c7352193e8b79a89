"""Whether the tests notice a changed line: mutants drawn at random, each against the tests that execute its line.

    python -m tests.mutants draw [count] [seed]      draws mutants of this checkout and keeps them in MUTANTS
    python -m tests.mutants trace FOLDER [slow] ...  one run of a suite that notes which tests pass by which mutants
    python -m tests.mutants run FOLDER [slow]        each mutant against those tests, the nearest first, to a failure
    python -m tests.mutants table FOLDER             how many were killed, and processor time of the suites by folder

A run that takes four times as long as its tests did counts as killed. What `run` has answered stands in FOLDER and is
not run again. `run FOLDER slow` takes those that the default suite left alive. Further words of `trace` go to pytest.
"""

import ast
import json
import os
import shutil
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from itertools import accumulate, takewhile
from pathlib import Path
from random import Random
from typing import Any, Final

import pytest

ROOT: Final = Path(__file__).parents[1]
MUTANTS: Final = Path(__file__).parent / "benchmarks" / "records" / "mutants.json"
AREAS: Final = (
    "dynamics", "sizing", "formulas", "features/seats", "features/balancing", "inputs", "reporting",
)  # fmt: skip
TRANSLATED: Final = "dynamics/integrators/compiled/"
"""Functions here are translated as they stand: a mutant is taken for passed where the loop goes on."""
GATE: Final = "abu_calc/dynamics/integrators/compiled/run.py", "    def _go_on(self) -> int:"
MOST: Final = 100.0
"""Processor seconds of the nearest tests that a mutant has to live through to count as alive."""
LOG, ONLY = "ABU_CALC_MUTANTS_LOG", "ABU_CALC_MUTANTS_ONLY"
SWAPS: Final[dict[type[Any], type[Any]]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult, ast.Mod: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip


@dataclass(frozen=True)
class Mutant:
    """A piece of a file and what replaces it; `line`, `column` from 1 and 0 in characters, `probe`: the line before
    which a statement can stand that notes who passes.
    """

    number: int
    file: str
    line: int
    column: int
    kind: str
    old: str
    new: str
    probe: int

    def applied(self, text: str) -> str:
        """The file with this change."""
        lines = text.splitlines(keepends=True)
        start = sum(map(len, lines[: self.line - 1])) + self.column
        assert text[start : start + len(self.old)] == self.old, f"the file has changed: {self}"
        return text[:start] + self.new + text[start + len(self.old) :]


def changed(node: ast.AST) -> Iterator[tuple[str, ast.AST | str]]:
    """Kinds of change of a node, each with what replaces it."""
    if isinstance(node, ast.BinOp) and type(node.op) in SWAPS and not any(map(_textual, (node.left, node.right))):
        yield "operator", ast.BinOp(node.left, SWAPS[type(node.op)](), node.right)
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        yield "comparison", ast.Compare(node.left, [SWAPS[type(node.ops[0])]()], node.comparators)
    if isinstance(node, ast.BoolOp):
        yield "condition", ast.BoolOp(SWAPS[type(node.op)](), node.values)
    if isinstance(node, ast.IfExp):
        yield "condition", ast.IfExp(ast.UnaryOp(ast.Not(), node.test), node.body, node.orelse)
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        value = node.value
        other = not value if isinstance(value, bool) else value + 1 if isinstance(value, int) else 1.25 * value or 1.0
        yield "constant", ast.Constant(other)
    if isinstance(node, ast.AugAssign) or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)):
        yield "removed statement", "pass"


def _textual(node: ast.AST) -> bool:
    number = isinstance(node, ast.Constant) and isinstance(node.value, (int, float))
    return isinstance(node, (ast.JoinedStr, ast.Constant)) and not number


def candidates(file: Path) -> Iterator[Mutant]:
    """All mutants of the functions of a file."""
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines(keepends=True)
    before = [0, *accumulate(map(len, lines))]

    def place(line: int, column: int) -> int:
        """Place in the text of a line from 1 and a column in bytes."""
        return before[line - 1] + len(lines[line - 1].encode()[:column].decode())

    def walk(node: ast.AST, inside: bool, probe: int) -> Iterator[Mutant]:
        if isinstance(node, (ast.JoinedStr, ast.match_case, ast.arguments)):
            return
        if isinstance(node, ast.stmt) and inside:
            start = lines[node.lineno - 1]
            if not start[: node.col_offset].strip() and not start.lstrip().startswith(("elif", "@")):
                probe = node.lineno
        if inside and isinstance(node, (ast.expr, ast.stmt)) and probe:
            for kind, other in changed(node):
                begin = place(node.lineno, node.col_offset)
                old = text[begin : place(node.end_lineno or 0, node.end_col_offset or 0)]
                new = other if isinstance(other, str) else f"({ast.unparse(ast.fix_missing_locations(other))})"
                name = file.relative_to(ROOT).as_posix()
                yield Mutant(0, name, node.lineno, begin - before[node.lineno - 1], kind, old, new, probe)
        function = isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
        for name, value in ast.iter_fields(node):
            if name in ("decorator_list", "returns", "annotation", "args") and (function or name != "args"):
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from walk(child, inside or function, 0 if function and not inside else probe)

    yield from walk(ast.parse(text), False, 0)


def draw(count: int, seed: int) -> list[Mutant]:
    """Mutants at random, as many of each area; none twice at one place."""
    random, drawn = Random(seed), list[Mutant]()
    for index, area in enumerate(AREAS):
        every = [each for file in sorted((ROOT / "abu_calc" / area).rglob("*.py")) for each in candidates(file)]
        of_kind = defaultdict(list)
        for each in every:
            of_kind[each.kind].append(each)
        for _ in range(count // len(AREAS) + (index < count % len(AREAS))):
            some = of_kind[random.choice(sorted(of_kind))]
            drawn.append(some.pop(random.randrange(len(some))))
    return [Mutant(**{**asdict(each), "number": number}) for number, each in enumerate(drawn)]


def known() -> list[Mutant]:
    """The mutants that were kept."""
    return [Mutant(**each) for each in json.loads(MUTANTS.read_text(encoding="utf-8"))["mutants"]]


def copied(folder: Path) -> Path:
    """A copy of what is committed in this checkout."""
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run(["git", "clone", "-q", str(ROOT), str(folder)], check=True)
    return folder


def _environment(tree: Path, **more: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(tree), "ABU_CALC_CACHE": f"{tree}-cache", **more}


def trace(folder: Path, suite: str, *more: str) -> None:
    """Run a suite once with a note before each mutant's statement, and keep which tests pass where."""
    tree, log = copied(folder / "traced"), folder / f"{suite}-log"
    log.mkdir(parents=True, exist_ok=True)
    notes: dict[str, dict[int, list[int]]] = defaultdict(lambda: defaultdict(list))
    at_gate = []
    for each in known():
        if TRANSLATED in each.file:
            at_gate.append(each.number)
        else:
            notes[each.file][each.probe].append(each.number)
    for name, places in notes.items():
        lines = (tree / name).read_text(encoding="utf-8").splitlines(keepends=True)
        for line in sorted(places, reverse=True):
            lines.insert(line - 1, _note(lines[line - 1], places[line]))
        (tree / name).write_text("".join(lines), encoding="utf-8")
    name, begin = GATE
    text = (tree / name).read_text(encoding="utf-8")
    first = text.index("        at_once", text.index(begin))
    (tree / name).write_text(text[:first] + _note("        ", at_gate) + text[first:], encoding="utf-8")
    words = ["-n", "2", "-p", "tests.mutants", *(["-m", "slow"] if suite == "slow" else []), *more]
    environment = _environment(tree, **{LOG: str(log)})
    subprocess.run([sys.executable, "-m", "pytest", *words], cwd=tree, env=environment, check=False)


def _note(line: str, numbers: list[int]) -> str:
    return f"{line[: len(line) - len(line.lstrip(' '))]}__import__('tests.mutants', fromlist=['_']).passed({numbers})\n"


_noted: set[tuple[str, str]] = set()


def passed(numbers: list[int]) -> None:
    """Note that the test of this moment has come by these mutants."""
    test = os.environ.get("PYTEST_CURRENT_TEST", "").rpartition(" (")[0]
    if (str(numbers), test) not in _noted and os.environ.get(LOG):
        _noted.add((str(numbers), test))
        _say({"test": test, "passed": numbers})


def _say(row: dict[str, Any]) -> None:
    with (Path(os.environ[LOG]) / f"{os.getpid()}.jsonl").open("a", encoding="utf-8") as file:
        file.write(json.dumps(row) + "\n")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Note the processor time of a test, its processes included."""
    before = os.times()
    result = yield
    if LOG in os.environ:
        _say({"test": item.nodeid, "cpu_s": round(sum(os.times()[:4]) - sum(before[:4]), 3)})
    return result  # type: ignore[return-value]


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """A test that fails by itself tells nothing of a mutant."""
    if LOG in os.environ and report.failed:
        _say({"test": report.nodeid, "failed": True})


def pytest_configure(config: pytest.Config) -> None:
    """Who asks for a study that another test has made passes by what that one passed."""
    if LOG not in os.environ:
        return
    from tests import remembered

    key, written = remembered._key, remembered._written

    def asked(*arguments: Any, **named: Any) -> str:
        found = key(*arguments, **named)
        passed_by = os.environ.get("PYTEST_CURRENT_TEST", "").rpartition(" (")[0]
        _say({"test": passed_by, "asked": found})
        return found

    def made(found: str, result: Any) -> Any:
        _say({"test": os.environ.get("PYTEST_CURRENT_TEST", "").rpartition(" (")[0], "made": found})
        return written(found, result)

    remembered._key, remembered._written = asked, made


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Only the tests that were asked for, in that order."""
    if ONLY in os.environ:
        order = {name: place for place, name in enumerate(json.loads(Path(os.environ[ONLY]).read_text()))}
        items[:] = sorted((item for item in items if item.nodeid in order), key=lambda item: order[item.nodeid])


def traced(folder: Path, suite: str) -> tuple[dict[str, float], dict[int, set[str]]]:
    """Processor seconds of each test, and the tests that pass by each mutant."""
    seconds, tests = dict[str, float](), defaultdict[int, set[str]](set)
    made, asked, failed = defaultdict[str, set[str]](set), defaultdict[str, set[str]](set), set[str]()
    for file in (folder / f"{suite}-log").glob("*.jsonl"):
        for line in file.read_text(encoding="utf-8").splitlines():
            row = json.loads(line)
            if "cpu_s" in row:
                seconds[row["test"]] = row["cpu_s"]
            for number in row.get("passed", ()):
                tests[number].add(row["test"])
            if "failed" in row:
                failed.add(row["test"])
            if "made" in row:
                made[row["made"]].add(row["test"])
            if "asked" in row:
                asked[row["asked"]].add(row["test"])
    for number, found in tests.items():
        others = (asked[key] for key, makers in made.items() if makers & found)
        tests[number] = (found.union(*others) & set(seconds)) - failed
    return seconds, tests


def run(folder: Path, suite: str) -> None:
    """Each mutant against its tests, two side by side."""
    seconds, tests = traced(folder, suite)
    answers = folder / f"{suite}.jsonl"
    judged = {json.loads(line)["number"] for line in answers.read_text().splitlines()} if answers.exists() else set()
    alive = {row["number"] for row in _rows(folder, "default") if row["how"] == "survived"}
    wanted = [each for each in known() if each.number not in judged and (suite == "default" or each.number in alive)]
    trees = [copied(folder / f"tree-{k}") for k in range(2)]
    free = list(trees)

    def judge(mutant: Mutant) -> dict[str, Any]:
        tree = free.pop()
        every = sorted(tests[mutant.number], key=lambda name: (-_near(mutant.file, name), seconds[name]))
        spent = accumulate(seconds[name] for name in every)
        names = [name for name, until in zip(every, spent, strict=True) if until <= MOST]
        whole, place = (tree / mutant.file).read_text(encoding="utf-8"), tree.with_suffix(".json")
        (tree / mutant.file).write_text(mutant.applied(whole), encoding="utf-8")
        place.write_text(json.dumps(names))
        shutil.rmtree(f"{tree}-cache", ignore_errors=True)
        files = sorted({name.partition("::")[0] for name in names})
        words = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:xdist", "-p", "tests.mutants", "--tb=line"]
        words += ["-m", "slow" if suite == "slow" else "not slow and not hard", *files]
        limit = 120 + 8 * sum(seconds[name] for name in names)
        how, last = "survived", ""
        try:
            seen = subprocess.run(
                words, cwd=tree, env=_environment(tree, **{ONLY: str(place)}), timeout=limit, capture_output=True,
                text=True, check=False,
            ) if names else None  # fmt: skip
            last = "" if seen is None else next(
                (line for line in reversed(seen.stdout.splitlines()) if line.startswith(("FAILED", "ERROR"))), ""
            )  # fmt: skip
            how = "survived" if seen is None or seen.returncode in (0, 5) else "killed"
        except subprocess.TimeoutExpired:
            how = "killed by time"
        (tree / mutant.file).write_text(whole, encoding="utf-8")
        free.append(tree)
        return {"number": mutant.number, "how": how, "tests": len(names), "by": last[:160]}

    with ThreadPoolExecutor(len(trees)) as pool, answers.open("a") as file:
        for done in as_completed([pool.submit(judge, mutant) for mutant in wanted]):
            print(json.dumps(done.result()), file=file, flush=True)


def _near(file: str, test: str) -> int:
    """How many parts of its path a test shares with a file of the package: those of one place notice first."""
    mirrored = test.partition("::")[0].replace("tests/", "abu_calc/", 1).replace("/test_", "/")
    pairs = zip(file.split("/"), mirrored.split("/"), strict=False)
    return len(list(takewhile(lambda pair: pair[0] == pair[1], pairs)))


def _rows(folder: Path, suite: str) -> list[dict[str, Any]]:
    answers = folder / f"{suite}.jsonl"
    return [json.loads(line) for line in answers.read_text().splitlines()] if answers.exists() else []


def table(folder: Path) -> None:
    """Print what was killed, what lives, and where processor time went."""
    of = {each.number: each for each in known()}
    for suite in ("default", "slow"):
        rows = _rows(folder, suite)
        print(suite, dict(Counter(row["how"] for row in rows)))
        for row in rows:
            if row["how"] == "survived":
                each = of[row["number"]]
                print(f"  {each.number:3} {each.file}:{each.line} {each.kind}: {each.old[:60]!r} -> {each.new[:60]!r}")
        times = Counter[str]()
        for name, spent in traced(folder, suite)[0].items():
            times["/".join(name.partition("::")[0].split("/")[: 3 if "features" in name else 2])] += spent  # type: ignore[assignment]
        for name, spent in times.most_common():
            print(f"  {name:40} {spent:8.1f} s")
        print(f"  all {sum(times.values()):.0f} s")


def main() -> None:
    """One of the four steps."""
    step, *more = sys.argv[1:]
    if step == "draw":
        count, seed = (int(more[k]) if len(more) > k else value for k, value in ((0, 120), (1, 54)))
        drawn = {"seed": seed, "mutants": [asdict(each) for each in draw(count, seed)]}
        MUTANTS.write_text(json.dumps(drawn, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        return
    folder, suite = Path(more[0]).resolve(), "slow" if more[1:2] == ["slow"] else "default"
    if step == "table":
        table(folder)
    elif step == "trace":
        trace(folder, suite, *more[1 + (suite == "slow") :])
    else:
        run(folder, suite)


if __name__ == "__main__":
    main()
