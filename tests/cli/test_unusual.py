"""Every command that reads a file warns of what is unusual in it."""

from functools import partial
from pathlib import Path

import pytest

from abu_calc.features.design import study
from tests.cli.runner import abu

ODD = ("--set", "wheel.diameter_mm=60")
SAID = "larger than the wheel: wheel.diameter_mm = 60"
LOAD = ("--set", "bearing[0].radial_load_kN=800")


@pytest.mark.slow
@pytest.mark.parametrize(("arguments", "said"), [
    (("size", "msh-230", *ODD), SAID),
    (("stability", "msh-230", *ODD), SAID),
    (("effects", "msh-230", *ODD), SAID),
    (("simulate", "msh-230", *ODD, "--duration", "0.05"), SAID),
    (("check-fit", "mmg-3200k-knife-shaft", *LOAD), "Meant in N (0.8 kN) or kgf"),
    (("check-fit", "--designation", "6203", "--shaft", "k6", "--housing", "H7", "--radial-load-kN", "800"),
     "radial_load_kN = 800 (--radial-load-kN) is unusual"),
])  # fmt: skip
def test_results_and_reports_warn(
    arguments: tuple[str, ...], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    monkeypatch.setattr(study, "size", partial(study.size, starts="none"))  # start cases change none of this
    seen = abu(*arguments, "--json")
    assert any(said in warning for warning in seen.document["warnings"])
    assert said in seen.err  # where a program reads the document, people read this


def test_reports_show_it() -> None:
    told = " ".join(abu("check-fit", "mmg-3200k-knife-shaft", *LOAD).out.split())
    assert "bearing[0].radial_load_kN = 800 (--set) is unusual, 0.01 … 300 kN is usual. Meant in N (0.8 kN)" in told


def test_verify_names_the_file(tmp_path: Path) -> None:
    file = tmp_path / "seats.toml"
    file.write_text('[machine]\nname = "roll"\n[[bearing]]\ndesignation = "6203"\nradial_load_kN = 800\n'
                    '[expected]\nstatus = "fail"\n', encoding="utf-8")  # fmt: skip
    seen = abu("verify", str(file), "--json")
    assert seen.document["warnings"][0].startswith(f"{file}: bearing[0].radial_load_kN = 800 (line 5) is unusual")
    assert "is unusual" in abu("verify", str(file)).out.replace("\n", " ")
