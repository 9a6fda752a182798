# SPDX-License-Identifier: GPL-2.0-or-later
"""Conduction along bonds: finite differences on a lattice, heat balance, imposed temperature."""

from pathlib import Path

import numpy as np
import pytest

import heat_network
from liggghts_runs import HEADER, Body, Liggghts, dump, read_dump, simple_cubic, thermo

RADIUS = 0.5e-3
CONDUCTIVITY, SPECIFIC_HEAT, DENSITY = 134.0, 880.0, 2790.0
DIFFUSIVITY = CONDUCTIVITY / (DENSITY * SPECIFIC_HEAT)
HEAT = (
    f"fix heat all solidem/conduction law platonic conductivity {CONDUCTIVITY} "
    f"specific_heat {SPECIFIC_HEAT} density {DENSITY} initial_temperature 298\n"
)


def script_of(boundary: str, newton: str = "off") -> str:
    return HEADER + (
        f"boundary {boundary} {boundary} {boundary}\nnewton {newton}\nread_data body.data\n"
        f"neighbor 0.2e-3 bin\nneigh_modify every 1 delay 0 check no\npair_style none\n{HEAT}"
    )


@pytest.mark.parametrize("newton", ["on", "off"])
def test_simple_cubic_lattice_is_central_finite_differences(
    liggghts: Liggghts, tmp_path: Path, newton: str
) -> None:
    cells = (6, 5, 4)
    body = simple_cubic(cells, RADIUS, periodic=True)
    body.write(tmp_path / "body.data")
    spacing = 2 * RADIUS
    step = 0.1 * spacing**2 / DIFFUSIVITY
    start = np.random.default_rng(1).uniform(300, 800, len(body.position))
    script = script_of("p", newton) + "run 0\n"
    for atom, value in enumerate(start, 1):
        script += f"set atom {atom} property/atom Temp {value:.17g}\n"
    script += f"timestep {step:.17g}\n" + dump("temperature", 1, "f_Temp", "f_coordination")
    liggghts.run(tmp_path, script + "run 10\n")

    frames = read_dump(tmp_path / "temperature.txt")
    assert (frames[0][:, 0] == start).all()
    assert (frames[0][:, 1] == 6).all()
    worst = 0.0
    for n in range(10):
        now = frames[n][:, 0].reshape(cells)
        change = sum(np.roll(now, shift, axis) - now for axis in range(3) for shift in (1, -1))
        expected = now + DIFFUSIVITY * step / spacing**2 * change
        worst = max(worst, np.abs(frames[n + 1][:, 0].reshape(cells) / expected - 1).max())
    print(f"newton {newton}: largest relative difference in a step {worst:.1e}")
    assert worst <= 1e-14


def test_heat_supplied_is_the_heat_gained(liggghts: Liggghts, tmp_path: Path) -> None:
    body = simple_cubic((12, 3, 3), RADIUS)
    body.write(tmp_path / "body.data")
    script = script_of("s") + (
        "group hot id 100:108\ngroup cold id 1:9\n"
        "variable warming equal 500+1e4*step*dt\n"
        "fix hot hot solidem/temperature v_warming\nfix cold cold solidem/temperature 298\n"
        "timestep 1e-4\nthermo 50\nthermo_style custom step atoms f_heat f_hot f_cold\n"
        "thermo_modify format float %.17g norm no\n"
        + dump("temperature", 200, "f_Temp")
        + "run 200\n"
    )
    rows = thermo(liggghts.run(tmp_path, script))
    temperature = read_dump(tmp_path / "temperature.txt")
    assert temperature[0][99:, 0] == pytest.approx(500.0, rel=1e-15)
    assert temperature[200][99:, 0] == pytest.approx(700.0, rel=1e-14)
    assert (temperature[200][:9, 0] == 298.0).all()
    assert 298.0 < temperature[200][45, 0] < 700.0
    gained = rows[:, 2] - rows[0, 2]
    assert (np.diff(gained) > 0).all()
    assert rows[:, 3] + rows[:, 4] == pytest.approx(gained, abs=1e-13 * rows[-1, 2])


def test_uniform_temperature_stays(liggghts: Liggghts, tmp_path: Path) -> None:
    simple_cubic((3, 3, 3), RADIUS).write(tmp_path / "body.data")
    script = script_of("s") + "timestep 1e-4\n" + dump("temperature", 20, "f_Temp") + "run 20\n"
    liggghts.run(tmp_path, script)
    assert (read_dump(tmp_path / "temperature.txt")[20] == 298.0).all()


def test_an_unequal_pair_exchanges_what_the_law_says(liggghts: Liggghts, tmp_path: Path) -> None:
    radius = np.array([1.0e-3, 1.5e-3])
    position = np.array([[0, 0, 0], [2.4e-3, 0, 0]])
    box = np.full(3, 10e-3)
    Body(position, radius, np.array([[0, 1]]), -box, box).write(tmp_path / "body.data")
    script = script_of("f") + (
        "run 0\nset atom 2 property/atom Temp 400\ntimestep 1e-4\n"
        + dump("temperature", 1, "f_Temp")
        + "run 1\n"
    )
    liggghts.run(tmp_path, script)
    before, after = (read_dump(tmp_path / "temperature.txt")[n][:, 0] for n in (0, 1))
    # One neighbour: the table's first slope goes on below four faces, S_nd = 6√3 - 3 (4 - 6√3)/2;
    # the volume fraction is a quarter of diamond's, π√3/16.
    area = 6 * np.sqrt(3) - 3 * (4 - 6 * np.sqrt(3)) / 2
    power = area * radius.prod() * CONDUCTIVITY * (before[1] - before[0]) / 2.4e-3
    fraction = np.pi * np.sqrt(3) / 64
    capacity = SPECIFIC_HEAT * DENSITY * 4 / 3 * np.pi * radius**3 / fraction
    expected = before + 1e-4 * power * np.array([1, -1]) / capacity
    assert after == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("ranks", [1, 2])
def test_calibration_scales_areas_and_capacities(
    liggghts: Liggghts, tmp_path: Path, ranks: int
) -> None:
    """The body's exact heat capacity; and the platonic law at another pace, by the area factor over
    that of the capacities."""
    body = simple_cubic((6, 4, 3), RADIUS)
    body.radius = RADIUS * np.random.default_rng(4).uniform(0.875, 1.125, len(body.radius))
    body.write(tmp_path / "body.data")
    volume, factor, step = 8.3e-8, 0.83, 1e-4
    law = f"platonic-calibrated area_factor {factor} volume {volume}"
    calibrated = HEAT.replace("platonic", law)

    def run(fix: str, step: float) -> tuple[np.ndarray, np.ndarray]:
        script = script_of("s").replace(HEAT, fix) + (
            "group warm id 1:30\nrun 0\nset group warm property/atom Temp 798\n"
            f"timestep {step:.17g}\nthermo_style custom step atoms f_heat\n"
            "thermo_modify format float %.17g norm no\nthermo 100\n"
            + dump("temperature", 100, "f_Temp")
        )
        rows = thermo(liggghts.run(tmp_path, script + "run 100\n", ranks))
        return rows[:, 2], read_dump(tmp_path / "temperature.txt")[100][:, 0]

    uniform = script_of("s").replace(HEAT, calibrated) + (
        "thermo_style custom step atoms f_heat\nthermo_modify format float %.17g norm no\nrun 0\n"
    )
    energy = thermo(liggghts.run(tmp_path, uniform, ranks))[0, 2]
    assert energy == pytest.approx(DENSITY * SPECIFIC_HEAT * volume * 298, rel=1e-14)

    energies, temperature = run(calibrated, step)
    plain, _ = run(HEAT, step)
    capacity = energies[0] / plain[0]
    _, expected = run(HEAT, step * factor / capacity)
    assert np.ptp(temperature) > 100 and abs(capacity - 1) > 0.01
    assert np.abs(temperature - expected).max() <= 1e-12 * 500
    assert energies[-1] == pytest.approx(energies[0], rel=1e-13)


@pytest.mark.parametrize("newton", ["on", "off"])
def test_an_unstable_step_is_told(liggghts: Liggghts, tmp_path: Path, newton: str) -> None:
    """The limit is 2 over the largest eigenvalue of the network, here by numpy: a little below, the
    run goes; a little above, it is refused, and the message gives the limit."""
    body = heat_network.network()
    body.write(tmp_path)
    i, j = body.body.pairs.T
    matrix = np.zeros((len(body.volume), len(body.volume)))
    np.add.at(matrix, (i, i), body.conductance)
    np.add.at(matrix, (j, j), body.conductance)
    np.subtract.at(matrix, (i, j), body.conductance)
    np.subtract.at(matrix, (j, i), body.conductance)
    elements, conductance = body.walls["left"]
    matrix[elements, elements] += conductance
    imposed = np.arange(100, 120)  # the fastest may be among them: nothing hangs on those
    free = np.setdiff1d(np.arange(len(body.volume)), imposed)
    root = body.capacity[free] ** -0.5
    limit = 2 / np.linalg.eigvalsh(root[:, None] * matrix[np.ix_(free, free)] * root).max()
    script = heat_network.beginning(newton) + heat_network.VORONOI + heat_network.LEFT + (
        "group imposed id 101:120\nfix cold imposed solidem/temperature 298\n"
    )
    liggghts.run(tmp_path, script + f"timestep {0.98 * limit:.17g}\nrun 5\n")
    with pytest.raises(AssertionError, match="is unstable: conduction bears steps below") as failure:
        liggghts.run(tmp_path, script + f"timestep {1.03 * limit:.17g}\nrun 5\n")
    told = str(failure.value).split("steps below ")[1].split()[0]
    assert float(told) == pytest.approx(limit, rel=0.02)


def test_a_body_that_moves_after_heat_alone_feels_its_forces_once(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """While heat is all that happens forces are not set to zero; afterwards they are, in each step."""
    body = simple_cubic((4, 3, 3), RADIUS)
    motion = ("fix pull all addforce 2 -1 0\nfix motion all nve/sphere\ntimestep 1e-9\n"
              + dump("state", 20, "x", "y", "z", "fx", "fy", "fz") + "run 20\n")
    found = []
    for name, before in (("moves", ""), ("heats_first", "timestep 1e-9\n"
                                         + dump("forces", 1, "fx", "fy", "fz") + "run 5\nundump forces\nreset_timestep 0\n")):
        folder = tmp_path / name
        folder.mkdir()
        body.write(folder / "body.data")
        liggghts.run(folder, script_of("f") + before + motion)
        found.append(max(read_dump(folder / "state.txt").items())[1])
    assert (found[0][:, 3:] == [2, -1, 0]).all()
    assert (found[0] == found[1]).all()
    assert all((frame == 0).all() for frame in read_dump(tmp_path / "heats_first/forces.txt").values())
