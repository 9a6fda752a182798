# SPDX-License-Identifier: GPL-2.0-or-later
"""What every code looks like to the harness, and how a program is run."""

from __future__ import annotations

import os
import re
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, Sequence

import numpy as np
from compare.result import CodeFailure, Floats, Result
from contrib.prepared import Parameters, Plasticity, Specimen

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Job:
    """One run, the same for every code."""

    scene: Path  #: scene file, its specimen read from `prepared`'s
    prepared: Path  #: specimen with bonds, sets and columns, HDF5
    explained: Path  #: output of solidem explain --json
    specimen: Specimen
    parameters: Parameters
    observe_every: int  #: steps between rows of the history
    frame_every: int  #: steps between frames
    timeout: float  #: s
    options: dict[str, Any] = field(default_factory=dict)  #: of the case


@dataclass(frozen=True)
class TwoSpheres:
    """One beam between two spheres and the motions of its ends.

    Each motion starts from rest, unless the beam flows: then they follow one another.
    """

    position: Floats  #: (2, 3) m
    radius: float  #: of the spheres, m
    beam_radius: float  #: m
    young_modulus: float  #: Pa
    shear_modulus: float  #: Pa
    motions: Floats  #: (M, 4, 3): displacement of i, of j (m), rotation vector of i, of j (rad)
    law: str = "euler-bernoulli"  #: or "timoshenko", "spring"
    shear_coefficient: float = 0.9  #: of "timoshenko"
    plasticity: Plasticity | None = None  #: None: elastic


class Code(Protocol):
    """An adaptor: one file in compare/codes/."""

    name: str

    def missing(self) -> str | None:
        """Why the code cannot be used; None when it can."""

    def version(self) -> str:
        """What the program says of its version; OSError, SubprocessError or ValueError."""

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """Whether it computes the laws of a job by solidem's own source; None: one beam."""

    def run(self, job: Job, directory: Path) -> Result:
        """Runs a job with its files in a directory of its own; CodeFailure when that fails."""

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """(M, 4, 3) forces on i and j, moments on i and j, N and N·m; CodeFailure."""


def said_version(command: Sequence[str | Path], pattern: str) -> str:
    """The first group of a pattern in what a program says; ValueError when it is not there."""
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, errors="replace", timeout=60, check=False)
    if not (found := re.search(pattern, done.stdout + done.stderr, re.MULTILINE)):
        raise ValueError(f"{Path(str(command[0])).name} does not say which it is")
    return found.group(1).strip()


def run_program(command: Sequence[str | Path], directory: Path, timeout: float,
                environment: dict[str, str] | None = None) -> float:
    """Runs a program in a directory, its words in output.log; returns the seconds it took.

    CodeFailure when it is not there, fails or takes longer than `timeout` seconds.
    """
    directory.mkdir(parents=True, exist_ok=True)
    log = directory / "output.log"
    start = time.perf_counter()
    name = Path(str(command[0])).name
    try:
        with open(log, "wb") as output:
            done = subprocess.run(
                [str(word) for word in command], cwd=directory, stdin=subprocess.DEVNULL,
                stdout=output, stderr=subprocess.STDOUT, timeout=timeout, check=False,
                env={**os.environ, **(environment or {})})
    except OSError as error:
        raise CodeFailure(f"{name} cannot be started: {error.strerror}") from error
    except subprocess.TimeoutExpired as error:
        raise CodeFailure(f"{name} took longer than {timeout:g} s") from error
    if done.returncode != 0:
        lines = log.read_text(errors="replace").strip().splitlines()
        words = next((line for line in reversed(lines) if "error" in line.lower()),
                     lines[-1] if lines else "no message")
        raise CodeFailure(f"{name} ended with status {done.returncode}: {words.strip()[:200]}")
    return time.perf_counter() - start


def read_loads(path: Path, motions: int, code: str) -> Floats:
    """(M, 4, 3) loads from a text file of twelve numbers a line; CodeFailure."""
    try:
        loads: Any = np.loadtxt(path, ndmin=2)
    except (OSError, ValueError) as error:
        raise CodeFailure(f"{code} wrote no loads: {error}") from error
    if loads.shape != (motions, 12) or not np.isfinite(loads).all():
        raise CodeFailure(f"{code} wrote loads of shape {loads.shape}, or not numbers")
    return loads.reshape(motions, 4, 3)
