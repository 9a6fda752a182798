# SPDX-License-Identifier: GPL-2.0-or-later
"""LIGGGHTS with the styles of contrib/liggghts, built against the prebuilt library."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from compare.codes.base import ROOT, Job, TwoSpheres, run_program, said_version
from compare.codes.dump import read_dump, read_rows
from compare.codes.open_mpi import ONE_MACHINE, one_process
from compare.result import CodeFailure, Floats, Result
from contrib.liggghts.contacts import full, has_contacts, tool_places, types_of
from contrib.liggghts.export import (beam_lines, bond_words, bonds_of, central_lines,
                                     heat_lines, loose_lines, sphere_density, write_data)
from contrib.prepared import Beams, Parameters, PreparedError, Specimen

BUILD = ROOT / "contrib" / "liggghts" / "build_prebuilt"

HEAD = """\
units si
atom_style hybrid granular molecular
atom_modify map array sort 0 0.0
boundary {boundary}
newton {newton}
communicate single vel yes
special_bonds lj/coul 1 1 1
read_data specimen.data
pair_style none
neighbor {skin:.17g} bin
neigh_modify delay 0 once yes
timestep {time_step:.17g}
"""


# Columns of the history of motion that are not a grip's, and LIGGGHTS' words for them.
MOTION = {
    "kinetic_energy": "c_speed+c_spin",
    "elastic_energy": "c_stored-f_bonds[4]",
    "plastic_work": "f_bonds[1]",
    "fracture_energy": "f_bonds[2]",
    "broken_bonds": "f_bonds[3]",
    "contact_energy": "f_bonds[4]",
    "removed_elements": "f_bonds[5]",
    "bonds_formed": "f_bonds[6]",
}
# The same under central forces.
CENTRAL = {
    "kinetic_energy": "c_speed",
    "potential_energy": "c_stored",
    "dissipated_energy": "f_solidem_central[3]",
    "interactions": "f_solidem_central[1]",
    "largest_interpenetration": "f_solidem_central[2]",
    "crack_faces": "f_damage[1]",
    "removed": "f_damage[2]",
}


def _motion_columns(parameters: Parameters) -> dict[str, str]:
    """Those of MOTION or CENTRAL that a scene has, named as the standalone code names them."""
    if parameters.is_loose:
        return {"kinetic_energy": "c_speed+c_spin"}
    if forces := parameters.central_forces:
        damage = parameters.damage
        absent = set() if forces.dissipation else {"dissipated_energy"}
        absent |= set() if damage and damage.crack_threshold is not None else {"crack_faces"}
        absent |= set() if damage and damage.minimal_neighbours else {"removed"}
        return {name: words for name, words in CENTRAL.items() if name not in absent}
    rupture, contact = parameters.rupture, parameters.contact
    absent = set() if parameters.plasticity else {"plastic_work"}
    absent |= set() if rupture else {"fracture_energy", "broken_bonds"}
    absent |= set() if rupture and rupture.minimal_bonds else {"removed_elements"}
    absent |= set() if contact and rupture else {"contact_energy"}
    absent |= set() if contact and contact.rebonding_pressure else {"bonds_formed"}
    return {name: words for name, words in MOTION.items() if name not in absent}


def _damage_columns(parameters: Parameters) -> dict[str, tuple[str, ...]]:
    """What frames tell of cracks, and LIGGGHTS' words for it."""
    columns: dict[str, tuple[str, ...]] = {}
    damage = parameters.damage
    if damage and damage.crack_threshold is not None:
        columns["crack_face"] = ("f_damage[1]",)
    if damage and damage.minimal_neighbours:
        columns["removed"] = ("f_damage[3]",)
    return columns


def _resumed(script: str) -> str:
    """The script that goes on from half.restart: that has the bonds, the groups and what atoms have
    been given. The result begins there."""
    kept = [line for line in script.splitlines(keepends=True)
            if not line.startswith(("units", "atom_style", "boundary", "newton", "bond_", "group",
                                    "velocity", "run 0", "variable sources", "set "))]
    return "".join(kept).replace("read_data specimen.data", "read_restart half.restart")


def _imposed_energy(job: Job) -> float:
    """Energy of motion that grips impose, J, which counts nowhere."""
    radius = job.specimen.radius
    mass = (sphere_density(job.specimen, json.loads(job.explained.read_text()))
            * 4 / 3 * np.pi * radius**3)
    return sum(0.5 * float(mass[job.specimen.sets[f"grip.{grip.name}"]].sum())
               * sum(v * v for v in grip.velocity if v is not None)
               for grip in job.parameters.grips)


def _history_lines(parameters: Parameters, every: int) -> str:
    """Energies, and forces of bonds on the grips, go to history.txt."""
    lines = "compute speed all ke\n" + (
        "compute spin all erotate/sphere\n" if parameters.is_loose else
        "compute stored all pe pair\n" if parameters.central_forces else
        "compute spin all erotate/sphere\ncompute stored all pe bond\n")
    columns = []
    for number, words in enumerate(_motion_columns(parameters).values()):
        lines += f"variable motion{number} equal {words}\n"
        columns.append(f"${{motion{number}}}")
    for number in range(len(parameters.grips)):
        lines += f"compute pull{number} grip{number} reduce sum fx fy fz\n"
        for axis in (1, 2, 3):
            lines += f"variable pull{number}_{axis} equal c_pull{number}[{axis}]\n"
            columns.append(f"${{pull{number}_{axis}}}")
    return lines + (f'fix history all print {every} "{" ".join(["$(step)", *columns])}" '
                    'file history.txt title "#" screen no\n')


def _heat_columns(parameters: Parameters) -> dict[str, str]:
    """Columns of the history of heat, and the fixes whose scalars they are."""
    return {
        "thermal_energy": "heat",
        **{f"temperature.{name}.heat": f"temperature{number}"
           for number, name in enumerate(parameters.temperatures)},
        **{f"{name}.heat": f"exchange{number}"
           for number, name in enumerate(parameters.exchanges)}}


def _heat_lines(job: Job, explained: dict[str, Any], directory: Path) -> str:
    """Conduction and what heats the body; heat goes to the log."""
    fixes = " ".join(f"f_{fix}" for fix in _heat_columns(job.parameters).values())
    return (heat_lines(job.specimen, job.parameters, explained, directory)
            + f"thermo_style custom step {fixes}\nthermo {job.observe_every}\n"
            + "thermo_modify format float %.17g norm no\n")


def _read_thermo(path: Path) -> Floats:
    """Rows of the last thermo table of a log."""
    text = path.read_text(errors="replace")
    table = re.split(r"\n *Step ", text)[-1].partition("\nLoop time")[0]
    try:
        return np.array([line.split() for line in table.splitlines()[1:]], dtype=float)
    except ValueError as error:
        raise CodeFailure(f"liggghts wrote a torn log: {error}") from error


def _heat_of_the_start(job: Job, column: str) -> float:
    """Heat that brings elements to an imposed temperature at the start, J; the fix leaves it out."""
    law = job.parameters.conduction
    name = column.removeprefix("temperature.").removesuffix(".heat")
    value = job.parameters.temperatures.get(name)
    if law is None or value is None or column != f"temperature.{name}.heat":
        return 0.0
    capacity = job.specimen.column("conduction/heat_capacity")
    held = job.specimen.sets[f"temperature.{name}"]
    return float(capacity[held].sum() * (value - law.initial_temperature))


@dataclass
class Liggghts:
    """LIGGGHTS-PUBLIC 3.8.0 with our styles."""

    name: str = "liggghts"
    program: Path | None = None  #: None: the one that build_prebuilt makes
    ranks: int = 1
    restarts: bool = False  #: whether a run ends half-way and goes on from a restart file

    def missing(self) -> str | None:
        """Why LIGGGHTS cannot be used; builds the styles on first call."""
        if self.program is not None:
            return None if shutil.which(self.program) else f"{self.program} is not there"
        try:
            done = subprocess.run([BUILD], capture_output=True, text=True, check=False,
                                  timeout=600)
        except (OSError, subprocess.TimeoutExpired) as error:
            return f"{BUILD.name}: {error}"
        found = re.search(r"^program (.+)$", done.stdout, re.MULTILINE)
        if done.returncode != 0 or not found:
            return f"{BUILD.name} failed: {done.stderr.strip()[-300:]}"
        self.program = Path(found.group(1))
        return None

    def _execute(self, script: str, directory: Path, timeout: float) -> float:
        """Runs a script; returns the seconds of its last run's steps, writing left out."""
        (directory / "in.script").write_text(script)
        if reason := self.missing():
            raise CodeFailure(reason)
        assert self.program is not None
        ranks = (["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(self.ranks)]
                 if self.ranks > 1 else [])
        environment = ONE_MACHINE if self.ranks > 1 else one_process(directory)
        run_program([*ranks, self.program, "-in", "in.script"], directory, timeout,
                    {"OMP_NUM_THREADS": "1"} | environment)
        log = (directory / "output.log").read_text(errors="replace")
        found = re.findall(r"Loop time of (\S+) on", log)
        if not found:
            raise CodeFailure(f"liggghts did not finish its run; see {directory / 'output.log'}")
        writing = re.findall(r"Outpt time \(%\) = (\S+)", log)
        return float(found[-1]) - (float(writing[-1]) if writing else 0.0)

    def version(self) -> str:
        """What the program says it is."""
        return said_version([self.program or "liggghts", "-in", "/dev/null", "-log", "none"],
                            r"Version (LIGGGHTS[^,)]+)") + ", with solidem's styles"

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """The styles include solidem's headers; contacts of loose elements are LIGGGHTS' own."""
        return parameters is None or not parameters.is_loose

    def run(self, job: Job, directory: Path) -> Result:
        """Runs a job of beams, of conduction, of both, or of central forces."""
        try:
            return self._run(job, directory)
        except PreparedError as error:
            raise CodeFailure(f"liggghts: {error}") from error

    def _run(self, job: Job, directory: Path) -> Result:
        directory.mkdir(parents=True, exist_ok=True)
        specimen, parameters = job.specimen, job.parameters
        parameters.require_support()
        explained = json.loads(job.explained.read_text())
        bonds = bonds_of(specimen, parameters)
        types = types_of(specimen, parameters) if has_contacts(parameters) else None
        write_data(directory / "specimen.data", specimen, bonds,
                   sphere_density(specimen, explained), types, tool_places(specimen, parameters))
        script = HEAD.format(
            # Fragments under central forces fly anywhere.
            boundary=" ".join("p" if p else "m" if parameters.tools else "f"
                              if parameters.beams or parameters.conduction else "s"
                              for p in specimen.periodic),
            # Contacts that remember ask for newton off.
            newton="off" if has_contacts(parameters) else "on",
            skin=0.5 * float(specimen.radius.mean()), time_step=parameters.time_step)
        script += "" if parameters.beams else "bond_style none\n"
        columns: dict[str, tuple[str, ...]] = {}
        if parameters.conduction:
            script += _heat_lines(job, explained, directory)
            columns["temperature"] = ("f_Temp",)
        if parameters.beams:
            script += beam_lines(specimen, parameters, directory)
        if parameters.central_forces:
            script += central_lines(specimen, parameters)
            columns |= _damage_columns(parameters)
        if parameters.is_loose:
            script += loose_lines(specimen, parameters, directory)
        if parameters.beams or parameters.central_forces or parameters.is_loose:
            script += _history_lines(parameters, job.observe_every)
            columns["position"] = (("x", "y", "z") if parameters.beams else ("xu", "yu", "zu"))
        headings = [h for parts in columns.values() for h in parts]
        script += f"dump frames all custom {job.frame_every} frames.dump id {' '.join(headings)}\n"
        script += f'dump_modify frames sort id format "%d{" %.17g" * len(headings)}"\n'
        done = parameters.steps // 2 if self.restarts else 0
        if self.restarts:
            self._execute(f"{script}run {done}\nwrite_restart half.restart\n", directory, job.timeout)
            script = _resumed(script)
        wall = self._execute(f"{script}run {parameters.steps - done}\n", directory, job.timeout)
        frames = read_dump(directory / "frames.dump", columns, parameters.time_step, self.name)
        pairs = specimen.pairs if parameters.central_forces else bonds
        return Result(self.name, len(specimen.radius), len(pairs), parameters.steps,
                      parameters.time_step, wall, self._history(job, directory), frames)

    def _history(self, job: Job, directory: Path) -> dict[str, Floats]:
        """Heat, and forces of the grips on the body, which balance the bonds' on the grips."""
        history: dict[str, Floats] = {}
        if job.parameters.conduction:
            rows = _read_thermo(directory / "output.log")
            history = {"step": rows[:, 0], "time": rows[:, 0] * job.parameters.time_step}
            for number, name in enumerate(_heat_columns(job.parameters)):
                history[name] = rows[:, 1 + number] + _heat_of_the_start(job, name)
        if not (job.parameters.beams or job.parameters.central_forces or job.parameters.is_loose):
            return history
        rows = read_rows(directory / "history.txt", self.name)
        if history:  # which may begin a row earlier
            at = np.isin(history["step"], rows[:, 0])
            history = {name: column[at] for name, column in history.items()}
        history |= {"step": rows[:, 0], "time": rows[:, 0] * job.parameters.time_step}
        names = list(_motion_columns(job.parameters))
        history |= {name: rows[:, 1 + n] for n, name in enumerate(names)}
        history["kinetic_energy"] -= _imposed_energy(job)
        for number, grip in enumerate(job.parameters.grips):
            for axis, name in enumerate("xyz"):
                speed = grip.velocity[axis]
                force = -rows[:, 1 + len(names) + 3 * number + axis]
                history[f"grip.{grip.name}.force_{name}"] = 0 * force if speed is None else force
                if speed is not None:
                    history[f"grip.{grip.name}.displacement_{name}"] = speed * history["time"]
        return history

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """Puts two spheres in each place in turn and reads their forces and torques."""
        directory.mkdir(parents=True, exist_ok=True)
        specimen = Specimen(directory, spheres.position, np.full(2, spheres.radius),
                            np.array([[0, 1]]))
        write_data(directory / "specimen.data", specimen, specimen.pairs, np.ones(2))
        beams = Beams(spheres.young_modulus, spheres.shear_modulus, 1.0, "mean",
                      spheres.beam_radius, spheres.law, spheres.shear_coefficient)
        script = HEAD.format(boundary="f f f", newton="on", skin=spheres.radius,
                             time_step=1e-12)
        # The first run lets the bond see its rest length; then each place is a step of its own, for
        # a bond flows once a step.
        script += (f"bond_style solidem/beam\nbond_coeff 1 {bond_words(beams, spheres.plasticity)}\n"
                   "fix bonds all solidem/bonds\nfix motion all nve/solidem\nrun 0\n")
        for number, motion in enumerate(spheres.motions):
            for end in (0, 1):
                place = map(full, spheres.position[end] + motion[end])
                turn = " ".join(map(full, _quaternion(motion[2 + end])))
                script += "set atom {} x {} y {} z {}\n".format(end + 1, *place)
                script += f"set atom {end + 1} property/atom orientation {turn}\n"
            script += f"reset_timestep {number + 1}\n"
            script += (f"dump loads all custom 1 loads{number}.dump id fx fy fz tqx tqy tqz\n"
                       'dump_modify loads sort id format "%d %.17g %.17g %.17g %.17g %.17g %.17g"\n'
                       "run 0\nundump loads\n")
        self._execute(script, directory, timeout)
        columns = {"force": ("fx", "fy", "fz"), "moment": ("tqx", "tqy", "tqz")}
        loads = []
        for number in range(len(spheres.motions)):
            frames = read_dump(directory / f"loads{number}.dump", columns, 1.0, self.name)
            if not frames:
                raise CodeFailure(f"liggghts wrote no loads of motion {number}")
            found = frames[-1].columns
            loads.append(np.concatenate([found["force"], found["moment"]]))
        if not np.isfinite(loads).all():
            raise CodeFailure("liggghts wrote loads that are not numbers")
        return np.array(loads)


def _quaternion(rotation: Floats) -> Floats:
    """(4,) w, x, y, z of a rotation vector."""
    angle = float(np.linalg.norm(rotation))
    return np.array([np.cos(angle / 2), *(0.5 * np.sinc(angle / 2 / np.pi) * rotation)])
