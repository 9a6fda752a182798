# SPDX-License-Identifier: GPL-2.0-or-later
"""Richardson extrapolation: exact powers, scatter, and steps of heat whose limit is known."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = os.environ.get("SOLIDEM_PYTHON", str(ROOT / "build" / "release" / "python"))
PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))
sys.path.insert(0, PACKAGES)
from solidem import InputError  # noqa: E402
from solidem.converge import ELEMENTS, converge, extrapolated  # noqa: E402
from solidem.level import Level  # noqa: E402


def levels(limit: float, constant: float, order: float, sizes: list[float],
           scatter: float = 0, specimens: int = 1, seed: int = 0) -> list[Level]:
    """What would be found if Q = limit + constant h^order, but for the specimens."""
    noise = np.random.default_rng(seed)
    return [Level(1 / h, h, limit + constant * h**order + scatter * noise.standard_normal(specimens),
                  1.0) for h in sizes]


@pytest.mark.parametrize("order", [0.8, 1.0, 1.5, 2.0])
def test_an_exact_power_is_found(order: float) -> None:
    found = extrapolated("Q", "h", levels(7, 3, order, [4, 2, 1, 0.5]))
    assert found.order == pytest.approx(order, abs=1e-9)
    assert found.limit == pytest.approx(7, rel=1e-12)


def test_two_levels_take_the_order_that_is_given() -> None:
    assert extrapolated("Q", "h", levels(7, 3, 2, [2, 1]), order=2).limit == pytest.approx(7)
    assert extrapolated("Q", "h", levels(7, 3, 1, [2, 1])).order_interval is None
    with pytest.raises(InputError, match="expected two or more"):
        extrapolated("Q", "h", levels(7, 3, 1, [2]))


def test_the_limit_lies_in_its_interval_as_often_as_said() -> None:
    """Of specimens that scatter by a tenth of the error of the finest bodies."""
    inside = 0
    for seed in range(200):
        found = extrapolated("Q", "h", levels(7, 3, 1, [1, 0.7, 0.5, 0.35], 0.1, 3, seed), order=1)
        inside += found.interval[0] <= 7 <= found.interval[1]
    assert 180 <= inside <= 198


def test_scatter_that_hides_the_order_is_told() -> None:
    found = extrapolated("Q", "h", levels(7, 0.1, 1, [1, 0.8, 0.6], 1.0, 3))
    assert found.order == 1 and found.order_interval is None
    assert "these runs do not tell it" in found.table() and "take more seeds" in found.table()


@pytest.mark.parametrize("order", [0.6, 1.0, 1.6])
def test_of_packings_all_orders_count(order: float) -> None:
    """The limit lies in its interval though nobody tells the order, and the interval says what that costs: it
    is wider than one whose order is taken for right."""
    inside = wider = 0
    for seed in range(100):
        noise = np.random.default_rng(seed)
        bodies = []
        for elements in (300, 750, 1875, 4700):
            size = (elements / 300)**(-1 / 3)
            figures = 7 * (1 + 0.2 * size**order * (1 + 0.1 * noise.standard_normal(4)))
            bodies.append(Level(elements, elements**(-1 / 3), figures, 1.0))
        found = extrapolated("Q", ELEMENTS, bodies)
        taken = extrapolated("Q", ELEMENTS, bodies, order=order)
        assert found.order_interval is not None
        inside += found.interval[0] <= 7 <= found.interval[1]
        wider += np.ptp(found.interval) > np.ptp(taken.interval)
    assert inside >= 92
    assert wider >= 95


#: A row of elements, the first of which is held at 400 K.
HEAT = """
[specimen]
shape = "crystal"
lattice = "simple_cubic"
cells = [2, 1, 1]
element_radius = "0.1 mm"
[material]
density = "2790 kg/m^3"
conductivity = "100 W/(m K)"
specific_heat_capacity = "900 J/(kg K)"
[conduction]
law = "platonic"
initial_temperature = "300 K"
integrator = "explicit"
[[temperatures]]
name = "hot"
region = { axis = "x", side = "low", layers = 1 }
value = "400 K"
[[sensors]]
name = "end"
point = ["0.3 mm", "0.1 mm", "0.1 mm"]
quantity = "temperature"
[run]
duration = "3 ms"
"""


def test_steps_of_heat_converge_to_the_exponential(tmp_path: Path) -> None:
    """400 − 100 exp(−t/τ): explicit steps err in the first order, what is extrapolated a twentieth."""
    found = converge(HEAT, "sensor.end.temperature", key="run.time_step_ratio",
                     values=[0.2, 0.1, 0.05, 0.025], seeds=1, folder=tmp_path)
    finest = converge(HEAT, "sensor.end.temperature", key="run.time_step_ratio",
                      values=[2e-4, 1e-4], seeds=1, folder=tmp_path)
    assert 350 < finest.limit < 399
    assert found.order == pytest.approx(1, abs=0.1)
    assert found.limit == pytest.approx(finest.limit, abs=0.05 * abs(
        found.levels[-1].mean - finest.limit))
    low, high = found.interval
    assert low < finest.limit < high


def test_the_command_goes_on_from_the_runs_that_are_there(tmp_path: Path) -> None:
    scene = tmp_path / "heat.toml"
    scene.write_text(HEAT)

    def command(*words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([PROGRAM, "converge", scene, *words, "--output", tmp_path / "runs"],
                              text=True, capture_output=True, check=False)

    refined = ("--key", "run.time_step_ratio", "--values", "0.4,0.2,0.1")
    done = command("--of", "sensor.end.temperature", *refined)
    assert done.returncode == 0, done.stderr
    assert "order" in done.stdout and (tmp_path / "runs" / "convergence.png").exists()
    runs = sorted((tmp_path / "runs").glob("*/summary.json"))
    before = [path.stat().st_mtime_ns for path in runs]
    assert len(before) == 3
    assert command("--of", "sensor.end.temperature", *refined).stdout == done.stdout
    assert [path.stat().st_mtime_ns for path in runs] == before
    wrong = command("--of", "gauge.stress", *refined)
    assert wrong.returncode == 2 and "gauge.stress: no column of" in wrong.stderr
    wrong = command("--of", "sensor.end.temperature", "--elements", "10,20")
    assert wrong.returncode == 2 and "a specimen of shape crystal" in wrong.stderr
