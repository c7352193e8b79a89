"""`abu verify` as its users see it."""

from pathlib import Path

from tests.cli.runner import abu, again


def test_presets_keep_what_they_expect() -> None:
    seen = again("verify")
    assert seen.status == 0, seen.out


def test_verify_tells_differences_and_update_keeps_comments(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    text = abu("presets", "msh-230").out.replace('"autobalancer.ball_count" = ', '"autobalancer.ball_count" = 1')
    file.write_text(text, encoding="utf-8")
    seen = abu("verify", str(file))
    assert seen.status == 1 and "autobalancer.ball_count" in seen.out
    assert abu("verify", "--update", str(tmp_path / "machine.toml")).status == 0
    after = file.read_text(encoding="utf-8")
    assert after.split("[expected]")[0] == text.split("[expected]")[0]
    assert '"autobalancer.ball_count" = 5\n' in after
    (tmp_path / "other.toml").write_text(text.split("[expected]")[0], encoding="utf-8")
    assert abu("verify", str(tmp_path)).status == 0  # a folder may hold files that expect nothing
    seen = abu("verify", str(tmp_path / "other.toml"))
    assert seen.status == 2 and "--update" in seen.err


def test_verify_knows_tolerances(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    text = abu("presets", "mmg-3200k-knife-shaft").out.split("[expected]")[0]
    expected = '[expected]\n"fits.0.hoop_stress_MPa" = 80.0\n"fits.0.interference_um" = [2.0, 36.0]\n'
    file.write_text(text + expected, encoding="utf-8")
    assert abu("verify", str(file)).status == 1  # it is 78.0
    file.write_text(text + expected + '[expected.tolerance]\n"fits.0.hoop_stress_MPa" = 0.05\n', encoding="utf-8")
    assert abu("verify", str(file)).status == 0
    file.write_text(text + expected + '"fits.0.no_such_key" = 1\n', encoding="utf-8")
    assert abu("verify", str(file)).status == 1
