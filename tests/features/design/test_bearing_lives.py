"""Rating lives of a machine's bearings in `abu size`, from the loads of its own simulation."""

import math
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.cli.runner import abu

BEARINGS = """
[[bearing]]
name = "front"
designation = "6204"
radial_load_kN = 0.4
position_mm = 40.0
[[bearing]]
name = "rear"
designation = "6203"
radial_load_kN = 0.2
position_mm = 180.0
"""
ROOT = Path(__file__).parents[3]


@cache
def sized(bearings: str) -> dict[str, Any]:
    preset = (ROOT / "presets" / "msh-230.toml").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "machine.toml"
        file.write_text(preset.split("[expected]")[0] + bearings, encoding="utf-8")
        return abu("size", str(file), "--json").document


@pytest.mark.slow
def test_lives_follow_from_imbalance_and_residual() -> None:
    """MSh-230 grinds by its face: the constant force is the press force of 45 N with its friction, f = 0.35.

    The front bearing takes 180/140 of a force at the wheel. Its load without the autobalancer lies between the larger
    of both parts and their sum; L10h = 10⁶/(60 n)·(C/P)³.
    """
    document = sized(BEARINGS)
    front, rear = document["result"]["fits"][0], document["result"]["fits"][2]
    speed = 2 * math.pi * document["result"]["frequency"]["speed_hz"]
    rotating = 1e-6 * document["result"]["imbalance_g_mm"] * speed**2
    life = front["simulated_life"]
    parts = [180 / 140 * force for force in (rotating, 45 * math.hypot(1, 0.35))]
    assert max(parts) <= 1e3 * life["load_without_kN"] <= sum(parts)
    hours = 1e6 / (60 * speed * 30 / math.pi) * (front["dynamic_load_rating_kN"] / life["load_without_kN"]) ** 3
    assert life["life_without_h"] == pytest.approx(hours, rel=1e-3)
    assert life["load_with_kN"] < life["load_without_kN"] and life["life_with_h"] > life["life_without_h"]
    assert rear["simulated_life"]["load_without_kN"] == pytest.approx(life["load_without_kN"] * 40 / 180)
    checks = [check for check in document["checks"] if check["code"] == "ABU636"]
    assert [check["status"] for check in checks] == ["pass", "pass"]


@pytest.mark.slow
def test_without_places_the_lives_are_not_evaluated_and_do_not_decide() -> None:
    document = sized(BEARINGS.replace("position_mm", "# position_mm"))
    checks = [check for check in document["checks"] if check["code"] == "ABU636"]
    assert [check["status"] for check in checks] == ["not-done", "not-done"]
    assert all("position_mm" in check["remedy"] for check in checks)
    assert document["status"] == sized(BEARINGS)["status"]
