# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat that steps once in several steps of the motion: against solidem, on ranks, through a restart."""

import csv
from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import HEADER, Liggghts, dump, read_dump, simple_cubic, thermo
from test_coupled import BAR, FIGURES, INITIAL, LAMP, OUTSIDE, export, frame, solidem

EVERY = 7
STEPS = 1000  # no multiple of EVERY: heat steps with the last of them, too
HALF = 500  # nor this
SCENE = (BAR + OUTSIDE + LAMP).replace("[conduction]", f"[conduction]\nevery = {EVERY}")
RUN = f"[run]\nsteps = {STEPS}\ntime_step_ratio = 0.3\nobserve_every = 100\n[output]\nframes = 1\n"
HEATS = "f_temperature0 f_exchange0"
IN_THE_FILE = ("units", "atom_style", "boundary", "newton", "bond_", "group", "run", "variable", "set")


def script(folder: Path) -> str:
    """The exported script up to its run, with the figures of heat."""
    done = export(folder, SCENE + RUN)
    assert done.returncode == 0, done.stderr
    assert f" every {EVERY}\n" in (folder / "heat.in").read_text()
    text = (folder / "run.in").read_text()
    return (text[: text.index("dump ")] + FIGURES.replace("c_waiting", HEATS) + f"thermo {STEPS}\n"
            + dump("state", STEPS, "x", "y", "z", "f_Temp", "f_waitingHeat"))


@pytest.fixture(scope="module")
def whole(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """The bar on one rank: atoms at the start and at the end, and the figures at the end."""
    folder = tmp_path_factory.mktemp("whole")
    said = liggghts.run(folder, script(folder) + f"run {STEPS}\n")
    frames = read_dump(folder / "state.txt")
    return {"start": frames[0], "end": frames[STEPS], "figures": thermo(said)[-1, 1:]}


def differences(whole: dict[str, np.ndarray], other: np.ndarray) -> tuple[float, float]:
    """Of positions over the longest way, and of temperatures over their largest change."""
    way, off = np.abs(whole["end"] - whole["start"])[:, :3], np.abs(whole["end"][:, :4] - other[:, :4])
    return (float(off[:, :3].max() / way.max()),
            float(off[:, 3].max() / np.abs(other[:, 3] - INITIAL).max()))


def test_a_bar_whose_heat_waits_is_that_of_solidem(
    whole: dict[str, np.ndarray], tmp_path: Path
) -> None:
    """It flows, expands, softens and conducts, is cooled, held at a temperature and heated."""
    (tmp_path / "scene.toml").write_text(SCENE + RUN)
    solidem(tmp_path, "run", "scene.toml", "--output", "results", "--threads", "1")
    found = differences(whole, np.column_stack(frame(tmp_path, "0*.h5")))
    print("position {:.1e}, temperature {:.1e}".format(*found))
    assert np.abs(whole["end"][:, 3] - INITIAL).max() > 5
    assert max(found) <= 1e-9
    with open(tmp_path / "results" / "history.csv") as file:
        last = list(csv.DictReader(file))[-1]
    work, _, held, walled = whole["figures"]
    assert float(last["plastic_work"]) == pytest.approx(work, rel=1e-8)
    assert float(last["waiting_heat"]) == pytest.approx(whole["end"][:, 4].sum(), rel=1e-8)


@pytest.mark.parametrize("ranks, newton", [(1, "off on"), (2, "off"), (2, "off on")])
def test_ranks_differ_by_round_off(
    liggghts: Liggghts, tmp_path: Path, whole: dict[str, np.ndarray], ranks: int, newton: str
) -> None:
    text = script(tmp_path).replace("newton          off", f"newton          {newton}")
    liggghts.run(tmp_path, text + f"run {STEPS}\n", ranks)
    found = differences(whole, read_dump(tmp_path / "state.txt")[STEPS])
    print(found)
    assert max(found) <= 1e-9


@pytest.mark.parametrize("between", ["restart", "run"])
def test_what_stops_while_heat_waits_goes_on_as_one_run(
    liggghts: Liggghts, tmp_path: Path, whole: dict[str, np.ndarray], between: str
) -> None:
    """`stop` says where heat has its last step; steps and heat that wait come from the file."""
    text = script(tmp_path)
    first = f"run {HALF} stop {STEPS}\n"
    second = f"run {STEPS - HALF} stop {STEPS}\n"
    if between == "run":
        said = liggghts.run(tmp_path, text + first + second)
    else:
        liggghts.run(tmp_path, text + first + "write_restart half.restart\n", 2)
        for name, words in (("beams.in", (tmp_path / "beams.in").read_text()),
                            ("heat.in", (tmp_path / "heat.in").read_text()), ("resumed", text)):
            kept = "".join(line for line in words.splitlines(keepends=True)
                           if not line.startswith(IN_THE_FILE))
            (tmp_path / name).write_text(kept.replace("read_data       body.data",
                                                      "read_restart    half.restart"))
        said = liggghts.run(tmp_path, (tmp_path / "resumed").read_text() + second)
    found = differences(whole, read_dump(tmp_path / "state.txt")[STEPS])
    print(found)
    assert max(found) <= 1e-9
    assert thermo(said)[-1, 1:] == pytest.approx(whole["figures"], rel=1e-9)


WARM = (HEADER + "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\n"
        "pair_style none\nfix heat all solidem/conduction law platonic conductivity 100 "
        "specific_heat 1000 density 2500 initial_temperature 300 {words}\n"
        "group hot id 1\nfix hot hot solidem/temperature v_hot\nvariable hot equal {hot}\n"
        "timestep {step}\n" + dump("state", 1, "f_Temp"))


def test_heat_steps_as_long_as_it_waited(liggghts: Liggghts, tmp_path: Path) -> None:
    """Nothing moves: every fourth step of 1 ms is a step of 4 ms, and the rest of the run is one."""
    simple_cubic((4, 3, 2), 1e-2).write(tmp_path / "body.data")
    hot = "300+1e4*step*dt"
    liggghts.run(tmp_path, WARM.format(words="every 4", step=1e-3, hot=hot) + "run 8\nrun 2\n")
    waits = read_dump(tmp_path / "state.txt")
    liggghts.run(tmp_path, WARM.format(words="", step=4e-3, hot=hot) + "run 2\n")
    long = read_dump(tmp_path / "state.txt")
    assert (waits[3] == waits[0]).all() and (waits[7] == waits[4]).all()
    assert np.abs(long[2] - 300).max() > 1
    for few, many in ((1, 4), (2, 8)):
        assert waits[many] == pytest.approx(long[few], rel=1e-14)
    assert (waits[9] == waits[8]).all() and (waits[10] != waits[9]).any()


@pytest.mark.parametrize("words, step, message", [
    ("every 0", 1e-3, "every is a number of steps, 1 at least, but is 0"),
    ("every -3", 1e-3, "1 at least, but is -3"),
    ("every 2.5", 1e-3, "Expected integer"),
    ("every", 1e-3, "keyword without value: every"),
    ("every 1000", 1e-1, ", 1000 at a time, is unstable: conduction bears steps below"),
])
def test_a_clock_that_cannot_be(
    liggghts: Liggghts, tmp_path: Path, words: str, step: float, message: str
) -> None:
    simple_cubic((4, 3, 2), 1e-2).write(tmp_path / "body.data")
    with pytest.raises(AssertionError) as failure:
        liggghts.run(tmp_path, WARM.format(words=words, step=step, hot="300") + "run 1\n")
    assert message in str(failure.value)
