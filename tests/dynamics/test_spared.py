"""Functions without what is zero: the same digits as the whole ones."""

import ast
import math
import random

from abu_calc.dynamics.integrators.compiled.plain import MODULES
from abu_calc.dynamics.integrators.compiled.spared import spared, without

WHOLE = """
def rates(t, y, par, dy):
 a = (y[0] * par[0])
 b = (a + (par[1] * (y[1] - par[0])))
 c = ((b * par[2]) - par[0])
 d = (c / par[2])
 e = sin((d * par[3]))
 dy[0] = ((par[0] + e) + (a * y[1]))
 dy[1] = (-(d + (c * par[3])))
 return
"""


def test_the_same_digits_with_less() -> None:
    """Whichever parameters are 0 or 1."""
    (whole,) = ast.parse(WHOLE).body
    assert isinstance(whole, ast.FunctionDef)
    source = random.Random(3)
    for known in ({}, {0: 0.0}, {0: 0.0, 2: 1.0}, {1: 0.0, 3: 1.0}, {0: 0.0, 1: 0.0, 2: 1.0, 3: 0.0}):
        less = spared(whole, known)
        par = [known.get(k, source.uniform(-2, 2)) for k in range(4)]
        y, found = [source.uniform(-2, 2), source.uniform(-2, 2)], []
        for function in (whole, less):
            scope: dict[str, object] = {"sin": math.sin}
            exec(compile(ast.fix_missing_locations(ast.Module([function], [])), "<test>", "exec"), scope)
            dy = [9.0, 9.0]
            scope["rates"](0.5, y, par, dy)  # type: ignore[operator]
            found.append(dy)
        assert found[0] == found[1]
        size = len(ast.unparse(less))
        assert size < len(ast.unparse(whole)) if 0 in known else size <= len(ast.unparse(whole))


def test_rates_are_what_is_watched_without_storing_it() -> None:
    """Nothing is worked out for an array that is left out, and the others get the same digits."""
    (whole,) = ast.parse("""
def watched(t, y, par, dy, w):
 try:
  a = (y[0] * par[0])
  b = (a - 1.5)
  c = (b * b)
  dy[0] = b
  w[0] = (c + a)
  return
 except ArithmeticError:
  dy[0] = nan
""").body
    assert isinstance(whole, ast.FunctionDef)
    less = without(whole, "w", "rates")
    text, scope = ast.unparse(less), dict[str, object]()
    assert "c =" not in text and "w" not in text and "except ArithmeticError" in text
    exec(compile(ast.fix_missing_locations(ast.Module([less], [])), "<test>", "exec"), scope)
    dy = [9.0]
    scope["rates"](0.0, [2.0], [3.0], dy)  # type: ignore[operator]
    assert dy == [4.5] and [one.arg for one in whole.args.args][-1] == "w" and whole.name == "watched"


def test_one_name_is_one_thing_in_all_of_the_loop() -> None:
    """Plain Python runs the loop's modules with their names together."""
    known: dict[str, object] = {}
    for module in MODULES:
        for name, value in vars(module).items():
            if not name.startswith("__"):
                assert known.setdefault(name, value) is value or known[name] == value, f"{module.__name__}: {name}"
    assert "go" in known and "located" in known
