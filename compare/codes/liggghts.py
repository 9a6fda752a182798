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

from compare.codes.base import ROOT, Job, TwoSpheres, run_program
from compare.result import CodeFailure, Floats, Frame, Result
from contrib.yade.prepared import Beams, Grip, Specimen

BUILD = ROOT / "contrib" / "liggghts" / "build_prebuilt"

HEAD = """\
units si
atom_style hybrid granular molecular
atom_modify map array sort 0 0.0
boundary {boundary}
newton on
communicate single vel yes
special_bonds lj/coul 1 1 1
read_data specimen.data
pair_style none
bond_style {bond_style}
neighbor {skin:.17g} bin
neigh_modify delay 0 once yes
timestep {time_step:.17g}
"""


def _full(value: float) -> str:
    return f"{value:.17g}"


def write_data(path: Path, specimen: Specimen, density: Floats) -> None:
    """A LIGGGHTS data file; atom numbers are element indices plus one."""
    margin = 4 * float(specimen.radius.max())
    lower, upper = specimen.position.min(axis=0), specimen.position.max(axis=0)
    margin += 0.2 * float((upper - lower).max())
    low = np.where(specimen.periodic, specimen.lower, lower - margin)
    high = np.where(specimen.periodic, specimen.upper, upper + margin)
    count, bonds = len(specimen.radius), len(specimen.pairs)
    most = int(np.bincount(specimen.pairs.ravel(), minlength=1).max()) if bonds else 1
    with open(path, "w") as file:
        file.write(f"specimen\n\n{count} atoms\n{bonds} bonds\n1 atom types\n1 bond types\n"
                   f"{most} extra bond per atom\n\n")
        for a, b, name in zip(low, high, "xyz"):
            file.write(f"{_full(a)} {_full(b)} {name}lo {name}hi\n")
        file.write("\nAtoms\n\n")
        for n, (x, r, d) in enumerate(zip(specimen.position, specimen.radius, density)):
            words = " ".join(map(_full, (*x, 2 * r, d)))
            file.write(f"{n + 1} 1 {words} 1\n")
        if bonds:
            file.write("\nBonds\n\n")
            for n, (i, j) in enumerate(specimen.pairs + 1):
                file.write(f"{n + 1} 1 {i} {j}\n")


def read_dump(path: Path, columns: dict[str, tuple[str, ...]], time_step: float) -> list[Frame]:
    """Frames of a text dump sorted by id; `columns`: name -> headings of its components."""
    try:
        words = path.read_text().split("ITEM: TIMESTEP\n")[1:]
    except OSError as error:
        raise CodeFailure(f"liggghts wrote no dump: {error}") from error
    frames = []
    for text in words:
        head, _, body = text.partition("ITEM: ATOMS ")
        headings, _, numbers = body.partition("\n")
        names = headings.split()
        try:
            values = np.array(numbers.split(), dtype=float).reshape(-1, len(names))
        except ValueError as error:
            raise CodeFailure(f"liggghts wrote a torn dump: {error}") from error
        values = values[np.argsort(values[:, names.index("id")])]
        step = int(head.split()[0])
        found = {name: np.squeeze(values[:, [names.index(h) for h in parts]], axis=1)
                 if len(parts) == 1 else values[:, [names.index(h) for h in parts]]
                 for name, parts in columns.items()}
        frames.append(Frame(step, step * time_step, found))
    return frames


def _beam_lines(specimen: Specimen, beams: Beams) -> str:
    thickness = (f"pair {_full(beams.radius_ratio)}" if beams.radius_from == "pair"
                 else f"radius {_full(beams.radius_ratio * beams.mean_radius)}")
    return (f"bond_coeff 1 {_full(beams.young_modulus)} {_full(beams.shear_modulus)} {thickness}\n"
            "fix bonds all solidem/bonds\n")


def _group_lines(name: str, elements: Any) -> str:
    """A group of elements, a thousand numbers a line at most."""
    ids = [str(i + 1) for i in elements]
    return "".join(f"group {name} id {' '.join(ids[k:k + 1000])}\n"
                   for k in range(0, len(ids), 1000))


def _grip_lines(grips: list[tuple[Grip, Any]], every: int) -> str:
    """Grips moved steadily, all else integrated; the grips' forces go to history.txt."""
    lines, held, columns = "", [], []
    for number, (grip, elements) in enumerate(grips):
        if not grip.rotation_fixed:
            raise CodeFailure(f"grip {grip.name}: free rotation is not supported in this adaptor")
        group = f"grip{number}"
        held.append(group)
        lines += _group_lines(group, elements)
        speed = " ".join("NULL" if v is None else _full(v) for v in grip.velocity)
        lines += f"fix {group} {group} move linear {speed} units box\n"
        lines += f"compute {group} {group} reduce sum fx fy fz\n"
        for axis in (1, 2, 3):
            lines += f"variable {group}_{axis} equal c_{group}[{axis}]\n"
            columns.append(f"${{{group}_{axis}}}")
    if held:
        lines += f"group free subtract all {' '.join(held)}\n"
        lines += (f'fix history all print {every} "{" ".join(["$(step)", *columns])}" '
                  'file history.txt title "#" screen no\n')
    return lines + f"fix motion {'free' if held else 'all'} nve/solidem\n"


@dataclass
class Liggghts:
    """LIGGGHTS-PUBLIC 3.8.0 with our styles, serial."""

    name: str = "liggghts"
    program: Path | None = None  #: None: the one that build_prebuilt makes

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
        """Runs a script; returns the seconds of its first run's steps, writing left out."""
        (directory / "in.script").write_text(script)
        if reason := self.missing():
            raise CodeFailure(reason)
        assert self.program is not None
        run_program([self.program, "-in", "in.script"], directory, timeout,
                    {"OMP_NUM_THREADS": "1"})
        log = (directory / "output.log").read_text(errors="replace")
        found = re.search(r"Loop time of (\S+) on", log)
        if not found:
            raise CodeFailure(f"liggghts did not finish its run; see {directory / 'output.log'}")
        writing = re.search(r"Outpt time \(%\) = (\S+)", log)
        return float(found.group(1)) - (float(writing.group(1)) if writing else 0.0)

    def run(self, job: Job, directory: Path) -> Result:
        """Runs a job of beams, of conduction, or of both."""
        directory.mkdir(parents=True, exist_ok=True)
        specimen, parameters = job.specimen, job.parameters
        explained = json.loads(job.explained.read_text())
        volume = 4 / 3 * np.pi * specimen.radius**3
        density = (specimen.column("mechanics/mass") / volume if parameters.beams
                   else np.full(len(volume), float(explained["density"])))
        write_data(directory / "specimen.data", specimen, density)
        script = HEAD.format(
            boundary=" ".join("p" if p else "f" for p in specimen.periodic),
            bond_style="solidem/beam" if parameters.beams else "none",
            skin=0.5 * float(specimen.radius.mean()), time_step=parameters.time_step)
        columns: dict[str, tuple[str, ...]] = {}
        if parameters.conduction:
            law = explained["laws"]["conduction"]
            script += ("fix conduction all solidem/conduction law platonic "
                       f"conductivity {_full(parameters.conduction.conductivity)} "
                       f"specific_heat {_full(law['specific_heat_capacity'])} "
                       f"density {_full(explained['density'])} initial_temperature "
                       f"{_full(parameters.conduction.initial_temperature)}\n")
            for number, (name, value) in enumerate(parameters.temperatures.items()):
                script += _group_lines(f"hot{number}", specimen.sets[f"temperature.{name}"])
                script += f"fix hot{number} hot{number} solidem/temperature {_full(value)}\n"
            columns["temperature"] = ("f_Temp",)
        if parameters.beams:
            script += _beam_lines(specimen, parameters.beams)
            script += _grip_lines([(g, specimen.sets[f"grip.{g.name}"]) for g in parameters.grips],
                                  job.observe_every)
            columns["position"] = ("x", "y", "z")
        headings = [h for parts in columns.values() for h in parts]
        script += f"dump frames all custom {job.frame_every} frames.dump id {' '.join(headings)}\n"
        script += f'dump_modify frames sort id format "%d{" %.17g" * len(headings)}"\n'
        script += f"thermo {max(1, parameters.steps // 10)}\nrun {parameters.steps}\n"
        wall = self._execute(script, directory, job.timeout)
        frames = read_dump(directory / "frames.dump", columns, parameters.time_step)
        return Result(self.name, len(volume), len(specimen.pairs), parameters.steps,
                      parameters.time_step, wall, self._history(job, directory), frames)

    def _history(self, job: Job, directory: Path) -> dict[str, Floats]:
        """Forces of the grips on the body, which balance the bonds' forces on the grips."""
        if not job.parameters.grips or not job.parameters.beams:
            return {}
        try:
            rows = np.loadtxt(directory / "history.txt", ndmin=2)
        except (OSError, ValueError) as error:
            raise CodeFailure(f"liggghts wrote no usable history: {error}") from error
        history = {"step": rows[:, 0], "time": rows[:, 0] * job.parameters.time_step}
        for number, grip in enumerate(job.parameters.grips):
            for axis, name in enumerate("xyz"):
                history[f"grip.{grip.name}.force_{name}"] = -rows[:, 1 + 3 * number + axis]
                history[f"grip.{grip.name}.displacement_{name}"] = (
                    (grip.velocity[axis] or 0.0) * history["time"])
        return history

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """Puts two spheres in each place in turn and reads their forces and torques."""
        directory.mkdir(parents=True, exist_ok=True)
        specimen = Specimen(directory, spheres.position, np.full(2, spheres.radius),
                            np.array([[0, 1]]))
        write_data(directory / "specimen.data", specimen, np.ones(2))
        beams = Beams(spheres.young_modulus, spheres.shear_modulus, 1.0, "mean",
                      spheres.beam_radius)
        script = HEAD.format(boundary="f f f", bond_style="solidem/beam", skin=spheres.radius,
                             time_step=1e-12)
        # The first run lets the bond see its rest length.
        script += _beam_lines(specimen, beams) + "fix motion all nve/solidem\nrun 0\n"
        for number, motion in enumerate(spheres.motions):
            for end in (0, 1):
                place = map(_full, spheres.position[end] + motion[end])
                turn = " ".join(map(_full, _quaternion(motion[2 + end])))
                script += "set atom {} x {} y {} z {}\n".format(end + 1, *place)
                script += f"set atom {end + 1} property/atom orientation {turn}\n"
            script += (f"dump loads all custom 1 loads{number}.dump id fx fy fz tqx tqy tqz\n"
                       'dump_modify loads sort id format "%d %.17g %.17g %.17g %.17g %.17g %.17g"\n'
                       "run 0\nundump loads\n")
        self._execute(script, directory, timeout)
        columns = {"force": ("fx", "fy", "fz"), "moment": ("tqx", "tqy", "tqz")}
        loads = []
        for number in range(len(spheres.motions)):
            frames = read_dump(directory / f"loads{number}.dump", columns, 1.0)
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
