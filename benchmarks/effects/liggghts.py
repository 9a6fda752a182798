# SPDX-License-Identifier: GPL-2.0-or-later
"""The same effects in LIGGGHTS with the styles of contrib/liggghts, those that its export takes."""

from __future__ import annotations

import json
from pathlib import Path

from benchmarks.effects.scenes import scene
from compare.codes.base import Job
from compare.codes.liggghts import Liggghts
from compare.codes.standalone import Standalone
from compare.result import CodeFailure
from contrib.explained import parse_parameters
from contrib.prepared import PreparedError, read_specimen


def job_of(base: str, effect: str, steps: int, folder: Path) -> Job:
    """One run, of so many steps and one look at its end; PreparedError: LIGGGHTS has no such effect."""
    folder.mkdir(parents=True, exist_ok=True)
    standalone = Standalone()
    path, prepared = folder / "scene.toml", folder / "prepared.h5"
    path.write_text(scene(base, effect, steps).replace('"bar.h5"', f'"{folder.parent / "bar.h5"}"'))
    standalone.call(["prepare", path, "-o", prepared, "--overwrite"], folder / "prepare", 600)
    explained = standalone.call(["explain", path, "--json", "--quick"], folder / "explain", 600)
    parameters = parse_parameters(json.loads(explained.read_text()))
    return Job(path, prepared, explained, read_specimen(prepared), parameters, steps, steps, 1800)


def step_seconds(code: Liggghts, job: Job, folder: Path) -> float:
    """Of the step loop, a step."""
    result = code.run(job, folder).check()
    return result.wall_seconds / result.steps


def measured_in_liggghts(base: str, effects: dict[str, str], steps: int, rounds: int,
                         folder: Path) -> dict[str, tuple[list[float], list[float]] | str]:
    """Effect -> seconds of a step with it, and without it in the same round; or why there is none."""
    code = Liggghts()
    if reason := code.missing():
        return {effect: reason for effect in effects}
    without = job_of(base, "", steps, folder / "liggghts_base")
    found: dict[str, tuple[list[float], list[float]] | str] = {}
    jobs: dict[str, Job] = {}
    for number, (effect, text) in enumerate(effects.items()):
        try:
            jobs[effect] = job_of(base, text, steps, folder / f"liggghts_{number}")
            step_seconds(code, jobs[effect], jobs[effect].scene.parent)
            found[effect] = ([], [])
        except (CodeFailure, PreparedError) as failure:
            jobs.pop(effect, None)
            found[effect] = str(failure)
    for _ in range(rounds):
        for effect, job in jobs.items():
            before = step_seconds(code, without, without.scene.parent)
            with_it = step_seconds(code, job, job.scene.parent)
            after = step_seconds(code, without, without.scene.parent)
            times = found[effect]
            assert not isinstance(times, str)
            times[0].append(with_it)
            times[1].append((before + after) / 2)
    return found
