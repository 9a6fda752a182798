# SPDX-License-Identifier: GPL-2.0-or-later
"""From a prepared specimen to LIGGGHTS: contrib/liggghts/export.py."""

import json
import subprocess
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

import central_body
from heat_network import CONDUCTIVITY, DENSITY, SPECIFIC_HEAT, STEP, Network, network
from liggghts_runs import CONTRIB, HEADER, Liggghts, dump, read_dump, simple_cubic, thermo

STEPS, RADIUS = 50, 0.5e-3
EXPLAINED: dict[str, Any] = {
    "time_step": {"value": STEP},
    "steps": STEPS,
    "density": DENSITY,
    "laws": {
        "conduction": {
            "law": "voronoi",
            "conductivity": CONDUCTIVITY,
            "specific_heat_capacity": SPECIFIC_HEAT,
            "initial_temperature": 298.0,
            "integrator": "explicit",
        }
    },
    "temperatures": [{"name": "held", "value": {"time": [0.0], "value": [500.0]}}],
    "exchanges": [{"name": "left", "temperature": 798.0}, {"name": "right", "temperature": 280.0}],
    "powers": [{"name": "laser", "constant": True}, {"name": "lamp", "constant": True}],
}
HELD = np.arange(40, 50)
LASER, LAMP = np.arange(90, 110), np.arange(100, 120)


@pytest.fixture(scope="module")
def body() -> Network:
    return network()


def prepare(body: Network, folder: Path, explained: dict[str, Any]) -> subprocess.CompletedProcess:
    """Writes a prepared specimen and exports it to the folder `out`."""
    with h5py.File(folder / "prepared.h5", "w") as file:
        file["elements/position"], file["elements/radius"] = body.body.position, body.body.radius
        file["bonds/pairs"] = body.body.pairs[::3].astype("i4")  # the contacts, not the faces
        file["conduction/pairs"] = body.body.pairs.astype("i4")
        file["conduction/conductance"] = body.conductance
        file.create_group("domain").attrs["volume"] = body.volume.sum()
        file["conduction/area"], file["conduction/distance"] = body.area, body.distance
        file["conduction/volume"], file["conduction/heat_capacity"] = body.volume, body.capacity
        for name, (elements, conductance) in body.walls.items():
            file[f"conduction/exchanges/{name}/elements"] = elements.astype("i4")
            file[f"conduction/exchanges/{name}/conductance"] = conductance
        for name, elements in (("laser", LASER), ("lamp", LAMP)):
            file[f"conduction/powers/{name}/elements"] = elements.astype("i4")
            file[f"conduction/powers/{name}/power"] = np.full(len(elements), 3.0)
        file["sets/temperature.held"] = HELD.astype("i4")
    (folder / "explained.json").write_text(json.dumps(explained))
    return export(folder)


def export(folder: Path, *options: str) -> subprocess.CompletedProcess:
    """Exports what is prepared in a folder to its folder `out`."""
    return subprocess.run(
        [CONTRIB / "export.py", "prepared.h5", "explained.json", "out", *options],
        cwd=folder,
        capture_output=True,
        text=True,
    )


def expected(body: Network) -> np.ndarray:
    temperature = np.full(len(body.volume), 298.0)
    temperature[HELD] = 500
    source = np.zeros(len(body.volume))
    source[LASER] += 3
    source[LAMP] += 3
    for _ in range(STEPS):
        power = body.power(temperature, {"left": 798.0, "right": 280.0}) + source
        temperature = temperature + STEP / body.capacity * power
        temperature[HELD] = 500
    return temperature


@pytest.mark.parametrize("ranks", [1, 2])
def test_what_is_exported_runs(
    liggghts: Liggghts, tmp_path: Path, body: Network, ranks: int
) -> None:
    done = prepare(body, tmp_path, EXPLAINED)
    assert done.returncode == 0, done.stderr
    script = HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 0.2e-3 bin\npair_style none\n"
        f"include heat.in\ntimestep {STEP}\n" + dump("state", STEPS, "f_Temp") + f"run {STEPS}\n"
    )
    liggghts.run(tmp_path / "out", script, ranks)
    found = read_dump(tmp_path / "out" / "state.txt")[STEPS][:, 0]
    assert np.abs(found / expected(body) - 1).max() <= 1e-13


@pytest.mark.parametrize(
    "change, message",
    [
        ({"exchanges": [{"name": "left", "temperature": None}]}, "exchange left: varies with time"),
        ({"powers": [{"name": "torch", "constant": False}]}, "heat source torch: varies"),
        ({"powers": [{"name": "torch", "constant": True}]}, "/conduction/powers/torch is missing"),
        (
            {"temperatures": [{"name": "held", "value": {"time": [0, 1], "value": [1, 2]}}]},
            "temperature held: ",
        ),
        ({"density": None}, "density is None; only one number"),
        (
            {"laws": {**EXPLAINED["laws"], "rupture": {"strain": 0.02}}},
            "bonds that break cannot conduct heat",
        ),
    ],
)
def test_what_cannot_be_exported_is_told(
    tmp_path: Path, body: Network, change: dict[str, Any], message: str
) -> None:
    done = prepare(body, tmp_path, {**EXPLAINED, **change})
    assert done.returncode != 0
    assert message in done.stderr
    assert not (tmp_path / "out" / "heat.in").exists()


@pytest.mark.parametrize("column", ["conductance", "heat_capacity"])
def test_a_second_material_is_told(tmp_path: Path, body: Network, column: str) -> None:
    prepare(body, tmp_path, EXPLAINED)
    (tmp_path / "out" / "heat.in").unlink()
    with h5py.File(tmp_path / "prepared.h5", "a") as file:
        file[f"conduction/{column}"][7] *= 2
    done = export(tmp_path)
    assert done.returncode != 0
    assert "only one material is understood" in done.stderr
    assert not (tmp_path / "out" / "heat.in").exists()


@pytest.mark.parametrize(
    "key, value, message",
    [
        ("integrator", "rkl2", "integrator 'rkl2'; only 'explicit'"),
        ("conductivity", {"temperature": [300], "value": [1]}, "conductivity is {"),
    ],
)
def test_laws_that_cannot_be_exported_are_told(
    tmp_path: Path, body: Network, key: str, value: Any, message: str
) -> None:
    law = {**EXPLAINED["laws"]["conduction"], key: value}
    done = prepare(body, tmp_path, {**EXPLAINED, "laws": {"conduction": law}})
    assert done.returncode != 0
    assert message in done.stderr


BEAMS: dict[str, Any] = {
    "time_step": {"value": 1e-7},
    "steps": STEPS,
    "density": DENSITY,
    "laws": {
        "beams": {
            "law": "timoshenko",
            "shear_coefficient": 0.85,
            "young_modulus": 3.5e10,
            "shear_modulus": 1.3e10,
            "radius_ratio": 0.3,
            "radius_from": "pair",
            "mean_radius": RADIUS,
        },
        "plasticity": {"law": "scaled-offset", "yield_strain": 1e-3, "hardening_ratio": 0.02},
        "rupture": {"elastic_strain": None, "strain": 0.02, "minimal_bonds": 1},
        "contact": {"stiffness_ratio": 0.5, "rebonding_pressure": None},
    },
    "grips": [
        {"name": "left", "rotation": "fixed",
         "axes": [{"kind": "velocity", "function": {"time": [0], "value": [v]}} for v in (0, 0, 0)]},
        {"name": "right", "rotation": "free",
         "axes": [{"kind": "velocity", "function": {"time": [0], "value": [20.0]}},
                  {"kind": "free"}, {"kind": "free"}]},
    ],
}
BY_HAND = """bond_style solidem/beam
bond_coeff 1 3.5e10 1.3e10 pair 0.3 law timoshenko 0.85 plasticity scaled-offset 3.5e7 7e8 &
  rupture_strain 0.02 contact 0.5
fix bonds all solidem/bonds minimal_bonds 1
group left id 1:9
group right id 64:72
group free subtract all left
fix left left move linear 0 0 0
fix motion free nve/solidem
velocity right set 20 0 0
fix right right setforce 0 NULL NULL
"""


def prepare_beams(folder: Path, explained: dict[str, Any]) -> subprocess.CompletedProcess:
    """Writes a prepared bar and exports it to the folder `out`."""
    body = simple_cubic((8, 3, 3), RADIUS)
    count = len(body.position)
    body.position += 0.05 * RADIUS * np.random.default_rng(4).normal(size=(count, 3))
    with h5py.File(folder / "prepared.h5", "w") as file:
        file["elements/position"], file["elements/radius"] = body.position, body.radius
        file["bonds/pairs"] = body.pairs.astype("i4")
        file["mechanics/mass"] = np.full(count, DENSITY * 4 / 3 * np.pi * RADIUS**3)
        file["sets/grip.left"] = np.arange(9).astype("i4")
        file["sets/grip.right"] = np.arange(count - 9, count).astype("i4")
    (folder / "explained.json").write_text(json.dumps(explained))
    return export(folder, "--nearly")  # contacts are those of broken bonds alone


def test_exported_beams_do_as_the_same_by_hand(liggghts: Liggghts, tmp_path: Path) -> None:
    done = prepare_beams(tmp_path, BEAMS)
    assert done.returncode == 0, done.stderr
    assert "two elements that no bond ever joined pass through each other" in done.stderr
    assert not (tmp_path / "out" / "heat.in").exists()
    steps, states = 400, []
    for name, lines in (("exported", "include beams.in\n"), ("by hand", BY_HAND)):
        script = HEADER + (
            "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
            f"{lines}timestep 1e-7\nthermo_style custom step atoms f_bonds[1] f_bonds[3]\n"
            + dump("state", steps, "x", "y", "z", "fx", "fy", "fz", "omegax", "omegay", "omegaz")
            + f"run {steps}\n"
        )
        said = liggghts.run(tmp_path / "out", script)
        states.append((read_dump(tmp_path / "out" / "state.txt")[steps], thermo(said)[-1]))
    (exported, totals), (by_hand, totals_by_hand) = states
    assert totals[2] > 0 and totals[3] > 0, "it must flow and break"
    assert (totals == totals_by_hand).all()
    assert np.abs(exported[-9:, 6:]).max() > 0 == np.abs(exported[:9, 6:]).max()
    exported[-9:, 3] = 0  # as `fix setforce` has it
    scale = np.abs(by_hand).max(axis=0)
    assert (np.abs(exported - by_hand) / scale).max() <= 1e-9


@pytest.mark.parametrize(
    "change, message",
    [
        (
            {"grips": [{**BEAMS["grips"][0], "axes": [
                {"kind": "velocity", "function": {"time": [0, 1], "value": [0, 1]}}] * 3}]},
            "grip left: ",
        ),
        (
            {"laws": {**BEAMS["laws"], "beams": {**BEAMS["laws"]["beams"], "fibres": {"factor": 10}}}},
            "beams with fibres are not understood",
        ),
    ],
)
def test_beams_that_cannot_be_exported_are_told(
    tmp_path: Path, change: dict[str, Any], message: str
) -> None:
    done = prepare_beams(tmp_path, {**BEAMS, **change})
    assert done.returncode != 0
    assert message in done.stderr
    assert not (tmp_path / "out" / "beams.in").exists()


GRIPS = [
    {"name": "left end", "rotation": "free",
     "axes": [{"kind": "velocity", "function": {"time": [0.0], "value": [0.0]}}] * 3},
    {"name": "right", "rotation": "free",
     "axes": [{"kind": "velocity", "function": {"time": [0.0], "value": [4.0]}},
              {"kind": "free"}, {"kind": "free"}]},
]
CENTRAL: dict[str, Any] = {
    "time_step": {"value": 5e-8},
    "steps": STEPS,
    "density": DENSITY,
    "laws": {
        "central_forces": {
            "law": "mie", "parameters": central_body.LAWS["mie"], "range": 1.3,
            "equilibrium": "initial", "neighbours": "changing", "interpenetration": 0.2,
            "dissipation": 0.1, "skin": 0.2, "bond_tolerance": 0.1,
        },
        "damage": {"crack_threshold": 0.4, "every": 3, "minimal_neighbours": 2, "removal_every": 20},
    },
    "grips": GRIPS,
}


def test_exported_central_forces_do_as_the_same_by_hand(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """Masses that the specimen tells, grips that dissipation sees from the start."""
    body = central_body.shaken_block((6, 3, 3))
    body.velocity = None
    left, right = (np.flatnonzero(body.position[:, 0] * side < side * bound)
                   for side, bound in ((1, 0.5e-3), (-1, 7.5e-3)))
    assert len(left) > 5 and len(right) > 5
    with h5py.File(tmp_path / "prepared.h5", "w") as file:
        file["elements/position"], file["elements/radius"] = body.position, body.radius
        file["mechanics/mass"] = 2 * DENSITY * 4 / 3 * np.pi * body.radius**3
        file["sets/grip.left end"], file["sets/grip.right"] = left.astype("i4"), right.astype("i4")
    (tmp_path / "explained.json").write_text(json.dumps(CENTRAL))
    done = export(tmp_path)
    assert done.returncode == 0, done.stderr
    end = "timestep 5e-8\n" + central_body.state(STEPS, "f_damage[1]") + f"run {STEPS}\n"
    begin = HEADER + "boundary s s s\nnewton on\nread_data body.data\npair_style none\n"
    script = begin + "bond_style none\ninclude central.in\n"
    found = central_body.last_state(liggghts, tmp_path / "out", script + end)

    body.density = 2 * DENSITY
    central_body.write(body, tmp_path / "body.data")
    law = central_body.words("mie") + " range 1.3 tolerance 0.1 interpenetration 0.2 dissipation 0.1"
    script = central_body.beginning(law, "s s s", skin=0.2 * float(body.radius.mean()))
    for name, held, speed in (("left", left, "0 0 0"), ("right", right, "4 NULL NULL")):
        script += f"group {name} id {' '.join(map(str, held + 1))}\n"
        script += f"velocity {name} set {speed}\nfix {name} {name} move linear {speed}\n"
    script += "group free subtract all left right\nfix motion free nve\n"
    script += "fix damage all solidem/damage crack_threshold 0.4 every 3 minimal_neighbours 2 removal_every 20\n"
    expected = central_body.last_state(liggghts, tmp_path, script + end)
    assert np.abs(expected[:, 6:9]).max() > 1 and expected[:, 9].sum() > 5
    assert central_body.largest_difference(expected, found) <= 1e-12
    assert (expected[:, 9] == found[:, 9]).all()
