# SPDX-License-Identifier: GPL-2.0-or-later
"""What users get wrong: each is told where, what, and what would be right; nothing is lost."""

from __future__ import annotations

import os
import resource
import subprocess

import pytest

#: (what is done to the good scene, words that the message must hold)
SCENES = {
    "empty": (lambda text: "", ["bar.toml", "specimen"]),
    "misspelt section": (lambda t: t.replace("[beams]", "[beam]"),
                         ["bar.toml:9", "beam", "beams"]),
    "misspelt key": (lambda t: t.replace("radius_ratio", "radius_ration"),
                     ["bar.toml:12", "radius_ration", "radius_ratio"]),
    "unit in the wrong case": (lambda t: t.replace("3.5 TPa", "73 GPA"),
                               ["bar.toml:10", "young_modulus", "73 GPA", "GPa"]),
    "unit of another quantity": (lambda t: t.replace("3.5 TPa", "3.5 kg"),
                                 ["bar.toml:10", "young_modulus", "3.5 kg", "Pa"]),
    "no unit": (lambda t: t.replace('"3.5 TPa"', "3.5e12"), ["bar.toml:10", "young_modulus", "Pa"]),
    "negative radius": (lambda t: t.replace('"0.1 mm"', '"-0.1 mm"'),
                        ["bar.toml:6", "element_radius", "-0.1 mm"]),
    "missing value": (lambda t: t.replace('density = "2790 kg/m^3"\n', ""),
                      ["bar.toml", "density"]),
    "grips share elements": (lambda t: t.replace('side = "high", layers = 1', 'side = "high", layers = 9'),
                             ["right", "left", "share", "element"]),
    "grip without elements": (
        lambda t: t.replace('{ axis = "x", side = "high", layers = 1 }',
                            '{ lower = ["1 m", "any", "any"] }'), ["grip", "right", "no element"]),
    "element outside every set": (
        lambda t: t.replace('[material]\n', '[[material]]\nregion = { upper = ["1 mm", "any", "any"] }\n'),
        ["material", "element", "no material"]),
    "step above the limit": (lambda t: t.replace("time_step_ratio = 0.3", "time_step_ratio = 1.5"),
                             ["time step", "limit", "--force"]),
    "not TOML": (lambda t: t.replace("[beams]", "[beams"), ["bar.toml:9"]),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_bad_scene_is_refused_with_its_place(solidem, bar, name):
    spoil, words = SCENES[name]
    done = solidem("run", solidem.scene("bar.toml", spoil(bar)), "-o", "out")
    assert done.returncode == 2, done.stdout + done.stderr
    for word in words:
        assert word in done.stderr
    assert not (solidem.folder / "out").exists()


def test_a_forced_step_runs_into_divergence_which_is_reported(solidem, bar):
    text = bar.replace("time_step_ratio = 0.3", "time_step_ratio = 3.0")
    done = solidem("run", solidem.scene("bar.toml", text), "-o", "out", "--force")
    assert done.returncode == 1
    assert "diverged" in done.stderr
    assert (solidem.folder / "out" / "summary.json").exists()


def test_a_scene_that_is_not_there(solidem):
    done = solidem("run", "nowhere.toml")
    assert done.returncode == 2 and "nowhere.toml" in done.stderr


def test_a_scene_without_an_end(solidem):
    done = solidem("explain", "/dev/zero")
    assert done.returncode == 2
    assert "/dev/zero: more than 67108864 bytes; expected a scene file" in done.stderr


def test_stiffness_that_is_no_number_is_told(solidem, bar):
    """It is not said that bonds are missing, nor that something diverged."""
    for modulus, words in (("1e-320 Pa", "stiffness of the bonds is next to nothing"),
                           ("1e308 Pa", "the time step would be 0 s: the stiffness of the bonds")):
        done = solidem("explain", solidem.scene("bar.toml", bar), "--set", f'beams.young_modulus="{modulus}"')
        assert done.returncode == 2
        assert words in done.stderr


def test_a_duration_of_no_step(solidem, bar):
    text = bar.replace("steps = 2000", 'duration = "1e-300 s"')
    done = solidem("run", solidem.scene("bar.toml", text), "-o", "out")
    assert done.returncode == 2
    assert "[run] duration = 1e-300 s: next to nothing beside a step of" in done.stderr


def test_going_on_from_beyond_the_end_is_told(solidem, bar):
    """Whether the end is a number of steps or a time."""
    def run(end: str, *words: str):
        text = bar.replace("steps = 2000", end)
        return solidem("run", solidem.scene("bar.toml", text), "-o", "out", "-q", *words)

    assert run("steps = 40").returncode == 0
    for end in ("steps = 30", 'duration = "30 ns"'):
        done = run(end, "--resume")
        assert done.returncode == 0
        assert "note: the checkpoint is of step 40, " in done.stderr
        assert "beyond the end that the scene asks for" in done.stderr
    assert "beyond" not in run("steps = 50", "--resume").stderr


def test_a_specimen_file_cut_short(solidem, bar):
    recipe = bar[bar.index("[specimen]"):bar.index("[material]")]
    assert solidem("specimen", solidem.scene("bar.toml", bar), "-o", "bar.h5").returncode == 0
    file = solidem.folder / "bar.h5"
    file.write_bytes(file.read_bytes()[:3000])
    done = solidem("run", solidem.scene("cut.toml", bar.replace(recipe, '[specimen]\nfile = "bar.h5"\n')))
    assert done.returncode == 2
    assert "bar.h5" in done.stderr


def test_a_full_disk_keeps_what_was_written(solidem, bar):
    scene = solidem.scene("bar.toml", bar.replace("steps = 2000", "steps = 20000")
                          .replace("observe_every = 50", "observe_every = 1"))

    def little_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (500_000, 500_000))

    done = subprocess.run([solidem.path, "run", scene, "-o", "out"], cwd=solidem.folder, text=True,
                          capture_output=True, timeout=120, check=False, preexec_fn=little_room)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "out/" in done.stderr
    rows = (solidem.folder / "out" / "history.csv").read_text().splitlines()
    assert len(rows) > 100
    assert all(row.count(",") == rows[0].count(",") for row in rows)


def test_no_permission_to_write(solidem, bar):
    # Root may write anywhere, so the folder's name is taken by a file.
    (solidem.folder / "out").write_text("")
    done = solidem("run", solidem.scene("bar.toml", bar), "-o", "out")
    assert done.returncode in (1, 2)
    assert "out" in done.stderr
    if os.geteuid() != 0:
        closed = solidem.folder / "closed"
        closed.mkdir(mode=0o500)
        done = solidem("run", "bar.toml", "-o", "closed/out")
        assert done.returncode == 1 and "closed" in done.stderr


def test_an_unknown_instruction_set(solidem, bar):
    done = solidem("run", solidem.scene("bar.toml", bar),
                   env={**os.environ, "SOLIDEM_INSTRUCTION_SET": "mmx"})
    assert done.returncode == 2
    assert "mmx" in done.stderr and "baseline" in done.stderr
