"""Results of sweeps in other processes, and as copies."""

import copy
import os
import pickle

import numpy as np
import pytest

import abu_calc
from tests.features.sweep.conftest import ECCENTRICITY, Sweeps


def unnamed(sweeps: Sweeps) -> abu_calc.SweepResult:
    """A sweep whose store is a temporary one."""
    return abu_calc.sweep(sweeps.machine, {ECCENTRICITY: "uniform(0.004, 0.016)"}, 4)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="Windows has no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_that_ends_leaves_the_members_there(sweeps: Sweeps) -> None:
    result = unnamed(sweeps)
    child = os.fork()
    if child == 0:
        result.members._kept = None  # as the end of the process lets go of it
        os._exit(0)
    os.waitpid(child, 0)
    assert np.isfinite(result.members["level_db"]).all()
    folder = result.members.store.parent
    assert folder.is_dir()
    del result
    assert not folder.exists()


@pytest.mark.slow
def test_copies_carry_the_members_of_a_temporary_store(sweeps: Sweeps) -> None:
    result = unnamed(sweeps)
    level, kind = result.members["level_db"], result.members["start.kind"]
    copies = [pickle.loads(pickle.dumps(result)), copy.deepcopy(result)]
    again = pickle.loads(pickle.dumps(copies[0]))
    folder = result.members.store.parent
    del result
    assert not folder.exists()
    for each in (*copies, again):
        assert (each.members["level_db"] == level).all() and (each.members["start.kind"] == kind).all()
        assert len(each.members) == 4 and each.members.units["level_db"] == "dB"


def test_copies_read_the_store_that_was_named_or_say_that_it_is_gone(
    sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(sweeps.folder)
    result = pickle.loads(pickle.dumps(sweeps.run("members.sqlite")))
    monkeypatch.chdir("/")
    assert len(result.members["level_db"]) == 12
    sweeps.store.unlink()
    with pytest.raises(abu_calc.OutputError, match=r"members\.sqlite: it cannot be opened"):
        result.members["level_db"]
