# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS as Debian packages it: its own pair styles for the (m,n) law, of which none is ours.

A pair of atom types has one distance of equilibrium and one range. Where all pairs of a body have
the same, its elements are of one type; else every element is a type of its own, so that every pair
has its own distance, initial or not.
"""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from compare.codes.base import Job, TwoSpheres, run_program, said_version
from compare.codes.dump import read_dump, read_rows
from compare.result import CodeFailure, Floats, Result
from contrib.prepared import CentralForces, Parameters, PreparedError, Specimen

#: Types, when each element is one: a line of the script for each pair of them.
MOST_TYPES = 300
#: Distances of equilibrium, radii and masses that differ by less are equal.
EQUAL = 1e-12

HEAD = """\
units si
atom_style atomic
atom_modify map array sort 0 0.0
boundary {boundary}
read_data specimen.data
neighbor {skin:.17g} {search}
neigh_modify delay 0 every 1 check yes
pair_style {style} {range:.17g}
include coefficients.in
timestep {time_step:.17g}
"""


def exponents_and_depth(forces: CentralForces) -> tuple[float, float, float]:
    """m, n and ε of a law of the (m,n) family; PreparedError for another."""
    given = forces.parameters
    if forces.law == "lennard-jones":
        return 12, 6, given["energy"]
    if forces.law == "mie":
        return given["repulsive_exponent"], given["attractive_exponent"], given["energy"]
    raise PreparedError(f"law {forces.law!r}; LAMMPS has mie and lennard-jones alone")


def coefficients(style: str, m: float, n: float, depth: float, equilibrium: float,
                 limit: float) -> str:
    """Words of pair_coeff; SI."""
    if style == "mie/cut":
        sigma = equilibrium * (n / m) ** (1 / (m - n))
        words = (depth, sigma, m, n, limit)
    elif style == "nm/cut":
        words = (depth, equilibrium, m, n, limit)
    else:
        raise ValueError(f"pair style {style!r}; known: nm/cut, mie/cut")
    return " ".join(f"{word:.17g}" for word in words)


def _require_support(job: Job) -> CentralForces:
    """The central forces of a job; PreparedError when LAMMPS has nothing like it."""
    parameters = job.parameters
    parameters.require_support()
    forces = parameters.central_forces
    if forces is None:
        raise PreparedError("LAMMPS runs central forces alone")
    if parameters.damage is not None:
        raise PreparedError("[damage] is not in LAMMPS")
    if forces.dissipation:
        raise PreparedError("dissipation between pairs is not in LAMMPS")
    if forces.neighbours != "changing":
        raise PreparedError(f"neighbours = {forces.neighbours!r}; LAMMPS has 'changing' alone")
    return forces


def _alike(values: Floats) -> bool:
    return bool(np.ptp(values) <= EQUAL * np.abs(values).max()) if len(values) else True


def _equilibria(specimen: Specimen, forces: CentralForces) -> Floats:
    """(N, N) distance of equilibrium of every pair, m."""
    together = specimen.radius[:, None] + specimen.radius[None]
    if forces.equilibrium == "initial":
        i, j = specimen.pairs.T
        together[i, j] = together[j, i] = specimen.rest_length
    return together


def _one_type(specimen: Specimen, forces: CentralForces) -> bool:
    radius = specimen.radius
    initial = specimen.rest_length if forces.equilibrium == "initial" else np.zeros(0)
    return (_alike(radius) and _alike(specimen.column("mechanics/mass"))
            and _alike(np.append(initial, 2 * radius[0])))


def _write_coefficients(path: Path, job: Job, forces: CentralForces, style: str) -> int:
    """Writes pair_coeff lines; returns the number of types."""
    specimen = job.specimen
    radius, (m, n, depth) = specimen.radius, exponents_and_depth(forces)
    if _one_type(specimen, forces):
        words = coefficients(style, m, n, depth, 2 * radius[0], 2 * forces.range * radius[0])
        path.write_text(f"pair_coeff 1 1 {words}\n")
        return 1
    count = len(radius)
    if count > MOST_TYPES:
        raise PreparedError(f"{count} elements that are not alike; as types of their own LAMMPS "
                            f"takes {MOST_TYPES}")
    equilibrium = _equilibria(specimen, forces)
    with open(path, "w") as file:
        for i in range(count):
            for j in range(i, count):
                limit = forces.range * (radius[i] + radius[j])
                words = coefficients(style, m, n, depth, float(equilibrium[i, j]), float(limit))
                file.write(f"pair_coeff {i + 1} {j + 1} {words}\n")
    return count


def _write_data(path: Path, specimen: Specimen, types: int, margin: float) -> None:
    """Atoms in a box that leaves them room where it is not periodic."""
    mass = specimen.column("mechanics/mass")
    lines = [f"solidem specimen\n\n{len(mass)} atoms\n{types} atom types\n"]
    for axis, name in enumerate("xyz"):
        low = float(specimen.position[:, axis].min()) - margin
        high = float(specimen.position[:, axis].max()) + margin
        if specimen.periodic[axis]:
            low, high = float(specimen.lower[axis]), float(specimen.upper[axis])
        lines.append(f"{low:.17g} {high:.17g} {name}lo {name}hi\n")
    lines.append("\nMasses\n\n")
    lines += [f"{kind + 1} {mass[kind]:.17g}\n" for kind in range(types)]
    lines.append("\nAtoms # atomic\n\n")
    lines += ["{} {} {:.17g} {:.17g} {:.17g}\n".format(n + 1, n + 1 if types > 1 else 1, *place)
              for n, place in enumerate(specimen.position)]
    path.write_text("".join(lines))


def _motion_lines(job: Job) -> str:
    """Grips move steadily, the others by velocity Verlet."""
    lines = ""
    for number, grip in enumerate(job.parameters.grips):
        elements = job.specimen.sets[f"grip.{grip.name}"] + 1
        lines += f"group grip{number} empty\n"
        for part in np.array_split(elements, -(-len(elements) // 50)):
            lines += f"group grip{number} id {' '.join(map(str, part))}\n"
        speed = " ".join("NULL" if v is None else f"{v:.17g}" for v in grip.velocity)
        lines += f"fix move{number} grip{number} move linear {speed} units box\n"
    held = " ".join(f"grip{number}" for number in range(len(job.parameters.grips)))
    if not held:
        return lines + "fix motion all nve\n"
    return lines + f"group free subtract all {held}\nfix motion free nve\n"


def _history_lines(job: Job) -> str:
    """Potential energy and what pairs do to the grips go to history.txt."""
    lines = "compute stored all pe pair\nvariable stored equal c_stored\n"
    lines += "thermo_modify norm no\n"
    columns = ["$(step)", "${stored}"]
    for number in range(len(job.parameters.grips)):
        lines += f"compute pull{number} grip{number} reduce sum fx fy fz\n"
        for axis in (1, 2, 3):
            lines += f"variable pull{number}_{axis} equal c_pull{number}[{axis}]\n"
            columns.append(f"${{pull{number}_{axis}}}")
    return lines + (f'fix history all print {job.observe_every} "{" ".join(columns)}" '
                    'file history.txt title "#" screen no\n')


@dataclass
class Lammps:
    """LAMMPS, serial, with one of its pair styles of the (m,n) law."""

    name: str = "lammps"
    style: str = "nm/cut"  #: or "mie/cut"
    program: str = "lmp"

    def missing(self) -> str | None:
        """Why LAMMPS cannot be used."""
        if shutil.which(self.program) is None:
            return f"no program {self.program!r} on the path (Debian package lammps)"
        return None

    def version(self) -> str:
        """What the program says it is."""
        return said_version([self.program, "-h"], r"Simulator - (.+)$") + f", {self.style}"

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """They are its own."""
        return False

    def run(self, job: Job, directory: Path) -> Result:
        """Runs a job of central forces of the (m,n) law."""
        try:
            return self._run(job, directory)
        except PreparedError as error:
            raise CodeFailure(f"{self.name}: {error}") from error

    def _run(self, job: Job, directory: Path) -> Result:
        directory.mkdir(parents=True, exist_ok=True)
        forces, specimen, parameters = _require_support(job), job.specimen, job.parameters
        mean = float(specimen.radius.mean())
        types = _write_coefficients(directory / "coefficients.in", job, forces, self.style)
        _write_data(directory / "specimen.data", specimen, types, mean)
        script = HEAD.format(
            boundary=" ".join("p" if p else "s" for p in specimen.periodic),
            # Bins do not work in a box that is small beside them.
            skin=forces.skin * mean, search="bin" if len(specimen.radius) > 100 else "nsq",
            style=self.style, range=2 * forces.range * float(specimen.radius.max()),
            time_step=parameters.time_step)
        script += _motion_lines(job) + _history_lines(job)
        script += f"dump frames all custom {job.frame_every} frames.dump id x y z\n"
        script += 'dump_modify frames sort id format line "%d %.17g %.17g %.17g"\n'
        script += f"run {parameters.steps}\n"
        (directory / "in.script").write_text(script)
        run_program([self.program, "-in", "in.script", "-log", "none"], directory, job.timeout,
                    {"OMP_NUM_THREADS": "1"})
        frames = read_dump(directory / "frames.dump", {"position": ("x", "y", "z")},
                           parameters.time_step, self.name)
        return Result(self.name, len(specimen.radius), len(specimen.pairs), parameters.steps,
                      parameters.time_step, self._wall(directory), self._history(job, directory),
                      frames)

    def _wall(self, directory: Path) -> float:
        log = (directory / "output.log").read_text(errors="replace")
        found = re.findall(r"Loop time of (\S+) on", log)
        if not found:
            raise CodeFailure(f"{self.name} did not finish its run; see {directory / 'output.log'}")
        writing = re.findall(r"Output +\| (\S+)", log)
        return float(found[-1]) - (float(writing[-1]) if writing else 0.0)

    def _history(self, job: Job, directory: Path) -> dict[str, Floats]:
        """Forces of the grips on the body, which balance the body's on the grips."""
        rows = read_rows(directory / "history.txt", self.name)
        time = rows[:, 0] * job.parameters.time_step
        history = {"step": rows[:, 0], "time": time, "potential_energy": rows[:, 1]}
        for number, grip in enumerate(job.parameters.grips):
            for axis, name in enumerate("xyz"):
                speed, force = grip.velocity[axis], -rows[:, 2 + 3 * number + axis]
                history[f"grip.{grip.name}.force_{name}"] = 0 * force if speed is None else force
                if speed is not None:
                    history[f"grip.{grip.name}.displacement_{name}"] = speed * time
        return history

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """LAMMPS is here for central forces alone."""
        raise CodeFailure(f"{self.name} runs no beams")
