"""The compiled language: each word does what it does in Python, and all else is refused with its place."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from abu_calc.dynamics.integrators.compiled import llvm_engine as machine
from abu_calc.dynamics.integrators.compiled import translator as language
from abu_calc.dynamics.integrators.compiled.llvm_text import LanguageError
from tests.rows import for_each

HEAD = "def go(x: Reals, k: Integers) -> int:\n"

BODIES = {
    "assignments": "a = x[0]\nb, c = a + 1, 2 * a\nb, c = c, b\nx[1], x[2] = b, c\nx[3] += 4\nd: float = 3\nx[4] = d",
    "arithmetic": "x[1] = -x[0] * 3 / (x[2] - 5) + x[3] ** 2 - x[4] ** -0.2\nk[0] = -k[1] + 2 * k[2] - 7",
    "whole numbers divide to real ones": "x[0] = k[0] / k[1]\nx[1] = 1 / 5",
    "if": "if x[0] < 0.5:\n x[1] = 1.0\nelif x[0] < 0.7:\n x[1] = 2.0\nelse:\n x[1] = 3.0",
    "while": "i = 0\nwhile x[0] < 1000.0:\n x[0] = x[0] * 2.0 + 1.0\n i += 1\nreturn i",
    "for": "for i in range(3):\n x[i] = i * 2.0\nfor j in range(k[0], 5):\n x[j] += j\nx[0] = j",
    "break and continue": "for i in range(8):\n if i == 2:\n  continue\n if i == 5:\n  break\n x[i] = 9.0\nx[7] = i",
    "a counter set inside": "for i in range(3):\n x[i] = 1.0\n i = 7",
    "loops in loops": "for i in range(2):\n for j in range(3):\n  if j > i:\n   break\n  x[3 * i + j] = 10 * i + j",
    "comparisons": (
        "for i in range(4):\n if x[i] <= x[i + 1]:\n"
        "  k[0] += 1\n if x[i] != 0.25 and k[i] >= 0 or i == 4:\n  k[1] += 2"
    ),
    "comparisons of whole numbers": (
        "if k[0] < k[1]:\n x[0] = 5.0\nif k[0] != 3:\n"
        " x[1] = 6.0\nif k[2] > 1:\n x[2] = 7.0"
    ),
    "conditions": "a = x[0] > 0.2\nb = not a\nif a == b:\n x[0] = 1.0\nif a and not b:\n x[1] = 2.0",
    "only where needed": "if k[0] >= 0 and x[k[0]] > -1.0 or x[99999999] > 0.0:\n x[0] = 8.0",
    "either": "x[0] = 1.0 if x[1] > 0.5 else -1.0\nx[2] = k[0] if x[3] < 9.0 else 0.5\nk[1] = 4 if k[2] > 0 else 5",
    "either, computed where taken": "x[0] = x[99999999] if x[1] > 7.0 else 2.0",
    "functions": (
        "x[0] = abs(-x[0]) + sqrt(x[1]) + sin(x[2]) - cos(30.0 * x[3])\n"
        "x[1] = min(x[4], x[5])\nx[2] = max(x[4], 3)"
    ),
    "min and max of whole numbers": "k[0] = max(k[1], k[2]) - min(k[1], 4)",
    "any and all": (
        "if any(x[i] > 0.9 for i in range(6)):\n x[0] = 1.0\n"
        "if all(x[i] < 2.0 for i in range(1, 6)):\n x[1] = 3.0"
    ),
    "parts of arrays": "z, h = x[3:], x[k[0] + 1 :]\nz[1] = 5.0\nh[0] = z[0]",
    "names from outside": "x[0] = SIZE * 2\nk[0] = COUNT\nx[1] = SIZE if YES else 0.0",
    "calls": "x[0] = half(x[1])\nraise_all(x[2:], 3)\nif large(k[1]):\n x[6] = 1.0",
    "groups": (
        "g = Pair(x[0] + 1, x[2:], k)\nx[0] = g.size\nx[1] = grown(3.0, g)\ng.row[1] = 2.0\n"
        "g = Pair(g.size + x[1], g.row, k)\nx[3] = grown(x[4], g) + g.count[0]\nrow, j = g.row, g.count[1]\nrow[5] = j"
    ),
    "a return ends it": "if x[0] > -1.0:\n return 5\nx[0] = 3.0",
    "nothing": "pass",
    "a text of its own": "'said'\nx[0] = 1.0",
    "what is no number": (
        "a = x[0] * INF - x[1] * INF\nif a < 1.0 or a >= 1.0 or a == a:\n"
        " x[0] = 1.0\nif a != a:\n x[1] = 2.0"
    ),
}  # fmt: skip
"""Ends of functions of an array of eight numbers between 0 and 1 and one of four whole numbers."""

OTHERS = (
    "class Pair(NamedTuple):\n 'A group.'\n size: float\n row: Reals\n 'A row.'\n count: Integers\n"
    "class Single(NamedTuple):\n size: float\n"
    "def grown(by: float, pair: Pair) -> float:\n pair.row[0] = by\n pair.count[0] += 1\n return by * pair.size\n"
    "def half(a: float) -> float:\n return a / 2\n"
    "def large(a: int) -> bool:\n return a > 1\n"
    "def raise_all(z: Reals, n: int) -> None:\n for i in range(n):\n  z[i] += 1.0\n"
)
NAMES = {"SIZE": 2.5, "COUNT": 3, "YES": True, "INF": math.inf}


def both(body: str) -> tuple[Callable[..., int], Callable[..., int]]:
    """A function as Python, and compiled."""
    text = OTHERS + HEAD + "".join(f" {line}\n" for line in (body + "\nreturn 0").splitlines())
    scope = {**NAMES, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "Reals": None, "Integers": None}
    scope["NamedTuple"] = NamedTuple
    exec(text, scope)
    loaded = machine.LoadedModule(machine.compiled(language.translated([(text, NAMES)], ("go",))))
    call = loaded.function("go", 2)
    return scope["go"], lambda x, k, keep=loaded: call(x.ctypes.data, k.ctypes.data)  # type: ignore[return-value]


@pytest.mark.parametrize("what", BODIES)
def test_a_word_does_what_it_does_in_python(what: str) -> None:
    plain, compiled = both(BODIES[what])
    for seed in range(5):
        rng = np.random.default_rng(seed)
        x, k = rng.random(8), rng.integers(1, 4, 4)
        again, counts = x.copy(), k.copy()
        with np.errstate(all="ignore"):
            assert plain(x, k) == compiled(again, counts)
        np.testing.assert_allclose(again, x, rtol=1e-15)
        assert counts.tolist() == k.tolist()


REFUSED = {
    "with x:\n pass": "no such word",
    "try:\n pass\nfinally:\n pass": "no such word",
    "a = [1]": "no such word",
    "a = lambda: 1": "no such word",
    "a = 'word'": "no number",
    "x[0] = y": "no such name",
    "x[0] = tan(1.0)": "no such function",
    "x[0] = sqrt(1.0, 2.0)": "one argument",
    "x[0] = half(1.0, 2.0)": "1 arguments",
    "x[0] = min(1.0, 2.0, 3.0)": "two arguments",
    "x[0] = half(a=1.0)": "no names",
    "x[0] = any(x)": "for … in range",
    "x[0] = k[0] // 2": "no such sign",
    "x[0] = k[0] % 2": "no such sign",
    "x[0] = ~k[0]": "no such sign",
    "k[0] = x[0]": "double where i64",
    "k[0] = x": "reals where i64",
    "if x[0]:\n pass": "no condition",
    "if 0 < x[0] < 1:\n pass": "one comparison",
    "for i in x:\n pass": "for name in range",
    "for i in range(1, 5, 2):\n pass": "for name in range",
    "for i in range(3):\n pass\nelse:\n pass": "no else",
    "x[1:] = 0.0": "nothing can be stored",
    "x.size = 0": "nothing can be stored",
    "z = x[:2]": "begins somewhere",
    "a = x[0][0]": "a named array",
    "a = 1.0\nx[0] = a[0]": "no array",
    "a = b = 1.0": "one assignment",
    "a, b = x": "as many values",
    "a: str = 1.0": "of a type",
    "g = Pair(1.0, x)": "3 values without names",
    "g = Pair(size=1.0, row=x, count=k)": "3 values without names",
    "g = Pair(1.0, k, k)": "integers where reals",
    "x[0] = Pair(1.0, x, k)": "a group has a name",
    "g = Pair(1.0, x, k)\nx[0] = g": "no such name",
    "g = Pair(1.0, x, k)\nx[0] = g.depth": "no such name",
    "g = Pair(1.0, x, k)\ng.size = 2.0": "nothing can be stored",
    "g = Pair(1.0, x, k)\ng = 1.0": "the name of a group",
    "g = Pair(1.0, x, k)\nfor g in range(3):\n pass": "the name of a group",
    "g = 1.0\ng = Pair(1.0, x, k)": "the name of something else",
    "g = Pair(1.0, x, k)\ng = Single(1.0)": "the name of something else",
    "x[0] = grown(1.0, x)": "a variable that is a Pair",
    "x[0] = grown(1.0, Pair(1.0, x, k))": "a variable that is a Pair",
    "return": "to be returned",
    "return 1.5": "double where i64",
}


@for_each(REFUSED)
def test_what_the_language_does_not_have_is_refused(body: str) -> None:
    text = OTHERS + HEAD + "".join(f" {line}\n" for line in body.splitlines())
    with pytest.raises(LanguageError, match=REFUSED[body]) as refused:
        language.translated([(text, NAMES)], ("go",))
    assert str(refused.value).startswith("go, line ")


def test_types_of_arguments_are_those_of_the_language() -> None:
    with pytest.raises(LanguageError, match="go, line 1: str is no type"):
        language.translated([("def go(x: str) -> int:\n return 0\n", {})], ("go",))
    with pytest.raises(LanguageError, match="Pair: str is no type"):
        language.translated([("class Pair(NamedTuple):\n name: str\n", {})], ())
    with pytest.raises(LanguageError, match="go, line 3: Pair is no type of a result"):
        language.translated([("class Pair(NamedTuple):\n a: int\ndef go(x: Pair) -> Pair:\n return x\n", {})], ("go",))


def test_what_llvm_refuses_is_told_as_what_it_is() -> None:
    with pytest.raises(machine.CompilerError, match="compiling: RuntimeError"):
        machine.compiled("define nonsense")
    loaded = machine.LoadedModule(machine.compiled(language.translated([], ())))
    with pytest.raises(machine.CompilerError, match="has no go"):
        loaded.address("go")
