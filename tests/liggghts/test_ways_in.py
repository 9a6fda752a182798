# SPDX-License-Identifier: GPL-2.0-or-later
"""The same results from the program on the prebuilt library, the preload of the stock LIGGGHTS, and
LIGGGHTS built from source with the styles dropped in."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

import central_body
import moving_bar
from liggghts_runs import CONTRIB, Liggghts, built_paths
from moving_bar import STEPS, beginning, largest_difference, state

SCRIPT = beginning() + state() + f"run {STEPS}\n"


@pytest.fixture(scope="module")
def reference(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    frame = moving_bar.run(liggghts, tmp_path_factory.mktemp("program"), SCRIPT)[STEPS]
    moving_bar.check_it_moved(frame)
    return frame


def test_preload_of_the_stock_program(
    prebuilt: dict[str, Path], reference: np.ndarray, tmp_path: Path
) -> None:
    stock = Liggghts("liggghts", {"LD_PRELOAD": str(prebuilt["preload"])})
    assert (moving_bar.run(stock, tmp_path, SCRIPT)[STEPS] == reference).all()


def test_stock_program_alone_does_not_know_the_styles(tmp_path: Path) -> None:
    with pytest.raises(AssertionError, match="Invalid bond style"):
        moving_bar.run(Liggghts("liggghts"), tmp_path, SCRIPT)


@pytest.mark.slow
@pytest.mark.parametrize("ranks", [1, 2])
def test_styles_dropped_into_the_source_tree(
    reference: np.ndarray, tmp_path: Path, ranks: int
) -> None:
    full = Liggghts(built_paths("install")["program"])
    frames = moving_bar.run(full, tmp_path, SCRIPT, ranks)
    difference = largest_difference(reference, frames[STEPS])
    print(f"from source, {ranks} ranks: {difference:.1e}")
    assert difference <= 1e-12


@pytest.mark.parametrize("instruction_set", ["baseline", "x86_64_v3"])
def test_every_instruction_set_moves_alike(
    prebuilt: dict[str, Path], reference: np.ndarray, tmp_path: Path, instruction_set: str
) -> None:
    program = Liggghts(prebuilt["program"], {"SOLIDEM_INSTRUCTION_SET": instruction_set})
    difference = largest_difference(reference, moving_bar.run(program, tmp_path, SCRIPT)[STEPS])
    print(f"{instruction_set}: {difference:.1e}")
    assert difference <= 1e-12


def test_hot_loops_of_an_instruction_set_hold_nothing_that_others_use(tmp_path: Path) -> None:
    """The linker keeps one of several functions of a name, which another machine may be unable to run."""
    for source in sorted((CONTRIB / "src").glob("solidem_kernels_*.cpp")):
        instruction_set = source.stem.removeprefix("solidem_kernels_")
        compiled = tmp_path / f"{instruction_set}.o"
        subprocess.run(["mpicxx", "-O2", "-Wno-psabi", f"-I{CONTRIB / 'src'}",
                        f"-I{CONTRIB.parents[1] / 'standalone'}", "-c", source, "-o", compiled],
                       check=True)
        names = subprocess.run(["nm", "-C", "--defined-only", "--extern-only", compiled],
                               capture_output=True, text=True, check=True).stdout.splitlines()
        assert names
        assert [name for name in names if instruction_set not in name] == []


CENTRAL = (
    central_body.beginning(central_body.words("threshold") + " range 1.3 dissipation 0.1")
    + "fix damage all solidem/damage crack_threshold 0.4 minimal_neighbours 6 removal_every 20\n"
    + "fix motion all nve\ntimestep 5e-8\n" + central_body.state(STEPS, "f_damage[1]")
    + f"run {STEPS // 2}\nwrite_restart half.restart\nrun {STEPS // 2}\n"
)


@pytest.mark.parametrize("way", ["preload", pytest.param("source", marks=pytest.mark.slow)])
def test_central_forces_by_every_way(
    liggghts: Liggghts, prebuilt: dict[str, Path], tmp_path: Path, way: str
) -> None:
    if way == "preload":
        other = Liggghts("liggghts", {"LD_PRELOAD": str(prebuilt["preload"])})
    else:
        other = Liggghts(built_paths("install")["program"])
    central_body.write(central_body.shaken_block(), tmp_path / "body.data")
    frames = [central_body.last_state(program, tmp_path, CENTRAL) for program in (liggghts, other)]
    assert frames[0][:, 9].sum() > 20
    assert (frames[0] == frames[1]).all()
