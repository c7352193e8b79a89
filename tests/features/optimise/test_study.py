"""The optimisation as a whole: its answer, its samples, its store, and what it refuses."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.optimise import racing
from abu_calc.features.optimise.result import OptimiseResult, written_text
from tests.features.optimise.conftest import CHOICES, OPTIONS

PRESET = "avtovaz-707-222"
DRAG, ECCENTRICITY = "autobalancer.rolling_drag_per_s", "autobalancer.race_eccentricity_mm"


@pytest.mark.hard
def test_the_cheapest_choice_that_settles_wins(small: OptimiseResult) -> None:
    best = small.recommended
    assert (best.set_[DRAG], best.set_[ECCENTRICITY]) == (20, 0.03)
    assert best.proven and small.status == "pass"
    assert best.fresh_share is not None and best.fresh_share.value >= small.share


@pytest.mark.slow
def test_the_front_rises_and_holds_the_recommended_design(small: OptimiseResult) -> None:
    costs, shares = [point.cost for point in small.front], [point.share for point in small.front]
    assert costs == sorted(costs)
    assert small.recommended.set_ in [point.set_ for point in small.front]
    assert all(point.low <= point.share <= point.high for point in small.front)
    assert shares == sorted(shares)


@pytest.mark.slow
def test_a_sweep_of_the_written_file_has_the_fresh_samples(small: OptimiseResult, tmp_path: Path) -> None:
    machine = abu_calc.read(PRESET)
    file = tmp_path / "best.toml"
    file.write_text(written_text(machine, small.recommended.set_, small), encoding="utf-8")
    fresh = small.recommended.fresh_share
    assert fresh is not None
    sweep = abu_calc.sweep(abu_calc.read(file), None, fresh.of, seed=fresh.seed)
    assert sweep.meets_limits.share == fresh.value
    assert sweep.meets_limits.confidence_interval == pytest.approx((fresh.low, fresh.high))


def _again(monkeypatch: pytest.MonkeyPatch, **more: Any) -> OptimiseResult:
    monkeypatch.setattr(racing, "ENOUGH", 32)
    return abu_calc.optimise(abu_calc.read(PRESET), CHOICES, **OPTIONS, **more)


@pytest.mark.hard
def test_any_executor_gives_the_same_answer(small: OptimiseResult, monkeypatch: pytest.MonkeyPatch) -> None:
    with ThreadPoolExecutor(3) as executor:
        assert _again(monkeypatch, executor=executor).to_dict() == small.to_dict()


@pytest.mark.hard
def test_a_store_goes_on_and_computes_nothing_twice(
    small: OptimiseResult, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    from abu_calc.features.optimise import racing as members

    store = tmp_path / "race.sqlite"
    computed: list[int] = []
    usual = members.SampleSource._compute

    def some(self: members.SampleSource, numbers: list[int]) -> None:
        computed.extend(numbers)
        if len(computed) > 60 and not store.with_suffix(".done").exists():
            store.with_suffix(".done").touch()
            raise KeyboardInterrupt
        usual(self, numbers)

    monkeypatch.setattr(members.SampleSource, "_compute", some)
    with pytest.raises(KeyboardInterrupt):
        _again(monkeypatch, store=store)
    interrupted = len(computed)
    result = _again(monkeypatch, store=store, resume=True)
    assert result.to_dict() | {"store": None} == small.to_dict()
    before = len(computed)
    assert _again(monkeypatch, store=store, resume=True).to_dict() | {"store": None} == small.to_dict()
    assert len(computed) == before > interrupted
    with pytest.raises(abu_calc.InputError, match="holds another study"):
        _again(monkeypatch, store=store, resume=True, seed=5)


@pytest.mark.hard
def test_an_impossible_share_gives_the_highest_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(racing, "ENOUGH", 32)
    machine = abu_calc.read(PRESET).changed({"limits.vibration_level_db": 82.0})
    result = abu_calc.optimise(machine, CHOICES, share=0.99, runs=100, samples=400)
    assert result.status == "fail"
    assert not result.recommended.proven
    assert result.recommended.set_[ECCENTRICITY] == 0.005
    assert result.recommended.share == max(point.share for point in result.front)


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "share above 1": ({"share": 95.0}, "share"),
    "share of a half": ({"share": 0.3}, "share"),
    "not a number": ({"share": float("nan")}, "share"),
    "few fresh samples": ({"runs": 10}, "runs"),
    "few samples": ({"samples": 3, "choose": {DRAG: "choice(4, 20)"}}, "samples"),
    "negative seed": ({"seed": -1}, "seed"),
    "unknown part": ({"share_parts": "spindle"}, "share_parts"),
    "unknown key": ({"choose": {"autobalancer.bal_count": "choice(3, 4)"}}, "bal_count"),
    "a distribution": ({"choose": {DRAG: "uniform(3, 4)"}}, "distribution"),
    "no list": ({"choose": ["rolling"]}, "not KEY"),
    "empty": ({"choose": {}}, "nothing to choose"),
    "chosen twice": ({"choose": [f"{DRAG}=choice(3,4)", f"{DRAG}=choice(5,6)"]}, "twice"),
    "value twice": ({"choose": {DRAG: "choice(3, 3)"}}, "twice"),
    "out of range": ({"choose": {DRAG: "choice(3, -4)"}}, DRAG),
    "text for a number": ({"choose": {DRAG: "choice(3, thick)"}}, DRAG),
    "a limit": ({"choose": {"limits.vibration_level_db": "choice(109, 120)"}}, "no value that a design"),
    "a start": ({"choose": {"start.kind": "choice(bunched)"}}, "no value that a design"),
    "a table of samples": ({"choose": {"sweep.runs": "choice(1, 2)"}}, "no value that a design"),
    "impossible balls": ({"choose": {"autobalancer.ball_diameter_mm": "choice(60, 70)"}}, "can be built"),
    "too many": ({"choose": {DRAG: "1:100:100", ECCENTRICITY: "0.001:0.1:100"}}, "too many"),
}


@pytest.mark.parametrize(("given", "words"), BAD.values(), ids=BAD.keys())
def test_wrong_input_is_refused_by_name(given: dict[str, Any], words: str) -> None:
    with pytest.raises(abu_calc.InputError, match=words):
        abu_calc.optimise(abu_calc.read(PRESET), **given)


def test_a_value_that_scatters_cannot_be_chosen() -> None:
    machine = abu_calc.read(PRESET).changed({"sweep.vary": [f"{DRAG}=uniform(5, 20)"]})
    with pytest.raises(abu_calc.InputError, match="scatters a value that is to be chosen"):
        abu_calc.optimise(machine, {DRAG: "choice(3, 4)"})
    with pytest.raises(abu_calc.InputError, match="machines are expected"):
        abu_calc.optimise([])


@pytest.mark.hard
def test_a_family_shares_balls_and_race(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(racing, "ENOUGH", 16)
    machines = [abu_calc.read(PRESET), abu_calc.read(PRESET).changed({"machine.mass_kg": 6.5})]
    result = abu_calc.optimise(machines, {DRAG: "choice(4, 20)"}, share=0.9, runs=100, samples=800)
    first, second = result.recommended.set_.values()
    for key in ("autobalancer.ball_diameter_mm", "autobalancer.race_radius_mm"):
        assert first[key] == second[key]
    assert result.share_parts == ("balls", "race")


def test_a_file_with_oil_chooses_among_grades() -> None:
    from abu_calc.features.optimise.choices import options_of
    from abu_calc.foundation.errors import Place

    oiled = abu_calc.read(PRESET)
    content = dict(oiled.document.content)
    content["autobalancer"] = {
        key: value for key, value in content["autobalancer"].items() if key != "rolling_drag_per_s"
    }
    content["oil"] = {"grade": "VG 46", "fill_ml": 2.0}
    machine = abu_calc.read(content)
    options = options_of(machine, None, Place())
    names = {option.name: [next(iter(value.values())) for value in option.values] for option in options}
    assert names["oil.grade"] == ["VG 32", "VG 46", "VG 68", "VG 100"]
    assert DRAG not in names
