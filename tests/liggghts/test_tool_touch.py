# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat that passes where elements touch tools: exported scenes against solidem, on ranks, through a
restart; bad words."""

import csv
from pathlib import Path

import h5py
import numpy as np
import pytest

from liggghts_runs import Liggghts, dump, read_dump, thermo
from test_export_contacts import write_sheet
from test_friction_heat import CONDUCTION, IN_THE_FILE, export, solidem, worst
from test_tool_friction_heat import BLOCK, DRAGGED, FLOOR, LID, METAL, WALL, require_refused

STEPS = 400
LAWS = ('conductance = "0.02 W/K"', 'coefficient = "3e7 W/(m^2 K)"')
RUN = f'[run]\nsteps = {STEPS}\ntime_step = "20 ns"\nobserve_every = 40\n[output]\nframes = 10\n'
PRESSED = DRAGGED.replace("-0.2 m/s", "-2 m/s")


def scene(law: str, more: str = "") -> str:
    """A block that is dragged over a floor, pressed and rubbing, under a lid that comes down as well."""
    lid = LID[: LID.index("velocity")] + ('velocity = ["7 m/s", "-4 m/s", "0 m/s"]\n'
                                          'stiffness = "3e6 N/m"\ntemperature = "250 K"\n')
    block = BLOCK.replace("[friction_heat]", f"[contact_conduction]\n{law}\n{more}\n[friction_heat]")
    return block + FLOOR + METAL + 'temperature = "500 K"\n' + lid + PRESSED


def script(folder: Path, text: str) -> str:
    """The exported script up to its run, with the figures of heat."""
    write_sheet(folder)
    done = export(folder, text + RUN, "--nearly")
    assert done.returncode == 0, done.stderr
    whole = (folder / "run.in").read_text()
    return (whole[: whole.index("thermo ")]
            + "compute waiting all reduce sum f_waitingHeat\n"
              "thermo_style custom step f_touch f_touch[1] f_touch[2] f_heat c_waiting f_friction "
              "f_friction[1]\nthermo_modify format float %.17g norm no\nthermo 40\n"
            + dump("state", 40, "x", "y", "z", "f_Temp"))


@pytest.mark.parametrize("law", LAWS)
def test_a_block_between_tools_is_as_warm_as_in_solidem(
    liggghts: Liggghts, tmp_path: Path, law: str
) -> None:
    rows = thermo(liggghts.run(tmp_path, script(tmp_path, scene(law)) + f"run {STEPS}\n"))
    frames = read_dump(tmp_path / "state.txt")
    solidem(tmp_path, "run", "scene.toml", "--output", "results", "--quiet", "--overwrite")
    with h5py.File(tmp_path / "results" / "trajectory.h5") as file:
        kept = [frame["temperature"][:] for _, frame in sorted(file["frames"].items())]
    with (tmp_path / "results" / "history.csv").open() as file:
        ours = list(csv.DictReader(file))
    change = max(np.abs(temperature - 300).max() for temperature in kept)
    off = [worst(frames[step][:, 3], temperature, change)
           for step, temperature in zip(sorted(frames), kept, strict=True)]
    print(change, max(off))
    assert change > 1e-3 and max(off) <= 1e-9
    for column, tool in ((2, "floor"), (3, "lid")):
        told = np.array([float(row[f"tool.{tool}.conducted_heat"]) for row in ours])
        assert np.abs(told[-1]) > 1e-6
        assert rows[:, column] == pytest.approx(told, abs=1e-9 * np.abs(told).max())
    made = 0.8 * rows[:, 6] - rows[:, 7] + rows[:, 1]
    assert rows[:, 4] + rows[:, 5] - rows[0, 4] == pytest.approx(made, abs=1e-13 * rows[0, 4])


@pytest.mark.parametrize("every", ["", "every"])
def test_ranks_and_a_restart_differ_by_round_off(
    liggghts: Liggghts, tmp_path: Path, every: str
) -> None:
    text = scene(LAWS[1])
    if every:
        text = text.replace("[conduction]", "[conduction]\nevery = 7")
    found = []
    for name, ranks in (("one", 1), ("two", 2), ("four", 4), ("resumed", 1)):
        folder = tmp_path / name
        folder.mkdir()
        lines = script(folder, text)
        if name == "resumed":
            half = STEPS // 2
            liggghts.run(folder, lines + f"run {half} stop {STEPS}\nwrite_restart half.restart\n", 2)
            for part in ("beams.in", "heat.in"):
                words = (folder / part).read_text().splitlines(keepends=True)
                (folder / part).write_text("".join(w for w in words if not w.startswith(IN_THE_FILE)))
            lines = "".join(line for line in lines.splitlines(keepends=True)
                            if not line.startswith(IN_THE_FILE))
            lines = lines.replace("read_data       body.data", "read_restart    half.restart")
            said = liggghts.run(folder, lines + f"run {STEPS - half}\n")
        else:
            said = liggghts.run(folder, lines + f"run {STEPS}\n", ranks)
        found.append((read_dump(folder / "state.txt")[STEPS][:, 3], thermo(said)[-1, 1:4]))
    change = np.abs(found[0][0] - 300).max()
    for temperature, heat in found[1:]:
        assert worst(temperature, found[0][0], change) <= 1e-9
        assert heat == pytest.approx(found[0][1], rel=1e-9)


def test_where_heat_leads_the_touches_are_of_the_step_before(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    done = export(tmp_path, scene(LAWS[0]).replace("[conduction]", "[conduction]\nevery = 7")
                  .replace(LID[: LID.index("velocity")], "").split("velocity = [\"7")[0] + PRESSED + RUN,
                  "--nearly")
    assert "heat passes through the touches of one step before" in done.stderr


CONTACT = '[contact]\nnormal_stiffness = "3e6 N/m"\n'


@pytest.mark.parametrize("change, words", [
    (("[friction_heat]", CONTACT + "[friction_heat]"),
     "[contact_conduction] beside [contact]: heat that passes between elements that touch is not"),
    (('temperature = "500 K"', 'temperature = { time = ["0 s", "1 s"], value = ["300 K", "400 K"] }'),
     "tool floor: temperature: "),
])
def test_scenes_that_are_not_taken_are_told(
    tmp_path: Path, change: tuple[str, str], words: str
) -> None:
    write_sheet(tmp_path)
    done = export(tmp_path, scene(LAWS[0]).replace(*change) + RUN, "--nearly")
    assert done.returncode != 0 and words in done.stderr, done.stderr


HISTORY = WALL.format("hooke/stiffness tangential history")
TOUCH = "fix touch all solidem/touch {}\n"


@pytest.mark.parametrize("lines, message", [
    (HISTORY + CONDUCTION + TOUCH.format("conductance 0 tool wall 300"), "conductance must be positive"),
    (HISTORY + CONDUCTION + TOUCH.format("conductance 1 tool wall -1"),
     "temperature of tool wall is counted from absolute zero and must not be below it, but is -1"),
    (HISTORY + CONDUCTION + TOUCH.format("conductance 1"), "needs either conductance or coefficient"),
    (HISTORY + CONDUCTION + TOUCH.format("conductance 1 coefficient 1 tool wall 300"),
     "needs either conductance or coefficient"),
    (HISTORY + CONDUCTION + TOUCH.format("conductance 1 tool wal 300"), "no fix wal for its tool"),
    (HISTORY + CONDUCTION + TOUCH.format("conductance 1 tool wall"), "keyword without value: tool"),
    (HISTORY + CONDUCTION + TOUCH.format("colour 1"), "unknown keyword 'colour'"),
    (HISTORY + TOUCH.format("conductance 1 tool wall 300"), "needs a 'fix ID all solidem/conduction'"),
    (CONDUCTION + HISTORY + TOUCH.format("conductance 1 tool wall 300"),
     "must be defined before this fix and fix solidem/conduction"),
])
def test_what_the_fix_cannot_do_it_says(
    liggghts: Liggghts, tmp_path: Path, lines: str, message: str
) -> None:
    require_refused(liggghts, tmp_path, lines, message)
