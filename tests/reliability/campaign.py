# SPDX-License-Identifier: GPL-2.0-or-later
"""Faults, one at a time: calls to the file system that fail or at which the program is killed, and
files with a bit that is wrong or an end that is missing. What must hold after each is in docs/reliability.md.

    /usr/bin/python3 tests/reliability/campaign.py             all of it, some minutes
    /usr/bin/python3 tests/reliability/campaign.py "kill, run" damage     what begins so

Most of a case is the program's start. Cases run side by side; TMPDIR in memory (/dev/shm) spares the disk.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("SOLIDEM_PROGRAM", ROOT / "build" / "release" / "solidem"))

SCENE = """\
title = "reliability"
[specimen]
shape = "crystal"
lattice = "bcc"
cells = [3, 2, 2]
element_radius = "0.1 mm"
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
[rupture]
stress = "40 GPa"
[[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
displacement = ["0 m", "0 m", "0 m"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1 }
velocity = ["50 m/s", "free", "free"]
[run]
steps = 120
time_step_ratio = 0.3
observe_every = 10
[output]
frames = 3
checkpoint_every = 40
"""


@dataclass(frozen=True)
class Outcome:
    """How a call of the program ended; a negative status is a signal."""

    status: int
    error: str
    calls: int = 0


def call(folder: Path, *words: str, **environment: str) -> Outcome:
    log = folder.parent / f"{folder.name}.calls"
    done = subprocess.run(
        [PROGRAM, *words], cwd=folder, text=True, capture_output=True, timeout=120, check=False,
        errors="replace",
        env={**os.environ, "OMP_NUM_THREADS": "1", "FAULTY_IO_LOG": str(log), **environment})
    calls = int(log.read_text()) if log.exists() else 0
    log.unlink(missing_ok=True)
    return Outcome(done.returncode, done.stderr, calls)


def build_shim(folder: Path) -> Path:
    """The library that makes calls fail."""
    library = folder / "faulty_io.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library,
                    Path(__file__).with_name("faulty_io.c"), "-ldl"], check=True)
    return library


# What the commands write, and whether it is as it should be.

def arrays_of(path: Path, frames_too: bool = True) -> dict[str, object]:
    """All data and attributes of an HDF5 file but the identity of the run."""
    found: dict[str, object] = {}

    def visit(name: str, item: h5py.HLObject) -> None:
        for key, value in item.attrs.items():
            if key != "run":
                found[f"{name}@{key}"] = value if isinstance(value, str) else np.asarray(value).tolist()
        if isinstance(item, h5py.Dataset):
            found[name] = (item.shape, item[()].tobytes())
        else:
            for key in item:
                if frames_too or key != "frames":
                    visit(f"{name}/{key}", item[key])

    with h5py.File(path) as file:
        visit("", file)
    return found


def content_of(path: Path) -> object:
    if path.suffix == ".h5":
        return arrays_of(path)
    if path.suffix == ".json":
        summary = json.loads(path.read_text())
        return {key: summary.get(key) for key in ("completed", "steps", "final", "elements", "bonds")}
    return path.read_bytes()


def results_of(folder: Path) -> dict[str, object]:
    """Each file with a final name, read whole: what is partial cannot be read."""
    return {str(path.relative_to(folder)): content_of(path) for path in sorted(folder.rglob("*"))
            if path.is_file() and path.suffix not in (".partial", ".aside", ".toml")}


def digest_of(folder: Path) -> str:
    """Of all names and bytes: of two folders that are alike, one need be looked at."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        content = path.read_bytes() if path.is_file() else b""
        digest.update(f"{path.relative_to(folder)} {len(content)} ".encode() + content)
    return digest.hexdigest()


@dataclass(frozen=True)
class Command:
    """A command under test: its words, what it starts from, and the folder or file that it writes."""

    name: str
    words: tuple[str, ...]
    output: str
    before: Callable[[Path], None] = lambda folder: None
    whole: bool = True  #: each file that is there must be the final one


def give_specimen(folder: Path) -> None:
    assert call(folder, "specimen", "scene.toml", "-o", "given.h5").status == 0


def give_stopped_run(folder: Path) -> None:
    """A run that stopped at a checkpoint two thirds of the way."""
    scene = folder / "scene.toml"
    scene.write_text(SCENE.replace("steps = 120", "steps = 80"))
    assert call(folder, "run", "scene.toml", "-o", "out", "-q").status == 0
    scene.write_text(SCENE)


COMMANDS = (
    Command("run", ("run", "scene.toml", "-o", "out", "-q"), "out", whole=False),
    Command("run --resume", ("run", "scene.toml", "-o", "out", "-q", "--resume"), "out",
            give_stopped_run, whole=False),
    Command("specimen .h5", ("specimen", "scene.toml", "-o", "body.h5"), "body.h5"),
    Command("specimen .data", ("specimen", "scene.toml", "-o", "body.data"), "body.data"),
    Command("prepare", ("prepare", "scene.toml", "-o", "body.h5"), "body.h5"),
    Command("convert .csv", ("convert", "given.h5", "body.csv"), "body.csv", give_specimen),
    Command("solve", ("solve", "solve.toml", "-o", "out", "-q"), "out", whole=False),
)

#: The bar at rest: its end is held where it is.
SOLVE = SCENE.replace('velocity = ["50 m/s", "free", "free"]',
                      'displacement = ["1e-7 m", "free", "free"]').replace(
    '[rupture]\nstress = "40 GPa"\n', "")


class Faults:
    """A command with a fault of one kind at each of its calls, in folders of its own."""

    def __init__(self, command: Command, how: str, folder: Path, shim: Path) -> None:
        self.command, self.how, self.folder, self.shim = command, how, folder, shim
        self.start = folder / "start"
        self.start.mkdir(parents=True)
        (self.start / "scene.toml").write_text(SCENE)
        (self.start / "solve.toml").write_text(SOLVE)
        command.before(self.start)
        good = self.call_faulty("good", 0)
        assert good.status == 0, good.error
        self.calls = good.calls
        self.sound: set[str] = set()  #: what killed programs left that was found to be in order
        self.expected = results_of(folder / "good")

    def call_faulty(self, name: str, at: int) -> Outcome:
        place = self.folder / name
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(self.start, place)
        return call(place, *self.command.words, LD_PRELOAD=str(self.shim),
                    FAULTY_IO_FOLDER=str(place), FAULTY_IO_AT=str(at), FAULTY_IO_HOW=self.how)

    def check(self, at: int) -> str:
        """Puts a fault at a call; "told", "harmless" or "killed". AssertionError: what went wrong."""
        how, name = self.how, f"{self.how}-{at}"
        done = self.call_faulty(name, at)
        place = self.folder / name
        where = f"{self.command.name}: {how} at call {at} of {self.calls}: status {done.status}, {done.error}"
        assert done.status in ((0, 1, 2) if how == "fail" else (0, -9)), where
        left = digest_of(place)
        if done.status != -9 or left not in self.sound:
            self.check_what_was_left(place, done, where)
        if done.status == -9:
            self.sound.add(left)
        shutil.rmtree(place)
        return "killed" if done.status == -9 else "harmless" if done.status == 0 else "told"

    def check_what_was_left(self, place: Path, done: Outcome, where: str) -> None:
        """Files are whole, words are right, and there is a way on."""
        found = results_of(place)  # fails where a file is partial
        if done.status == 0:
            assert not self.others(found), f"{where}: another {self.others(found)}"
        elif self.how == "fail":
            assert done.error.startswith("error: ") and self.names_a_file(done.error), where
        if self.command.whole:
            for file, content in found.items():
                earlier = "trajectory.h5" in file  # an index of the frames so far
                assert earlier or content == self.expected[file], f"{where}: {file}"
        if done.status != 0:
            self.check_the_way_on(place, where)

    def others(self, found: dict[str, object]) -> list[str]:
        """Names of what is not as expected."""
        return [name for name in {**found, **self.expected}
                if name not in found or found[name] != self.expected.get(name)]

    def names_a_file(self, error: str) -> bool:
        return any(name in error for name in (*self.command.words, "checkpoint", "history", "trajectory",
                                              "summary", "body", "given", str(self.folder)))

    def check_the_way_on(self, place: Path, where: str) -> None:
        """The same command again, or from the checkpoint, brings what was expected."""
        words = list(self.command.words)
        if "--resume" in words:
            pass
        elif (place / "out" / "checkpoint.h5").exists() and words[0] == "run":
            words.append("--resume")
        else:
            words.append("--overwrite")
        again = call(place, *words)
        assert again.status == 0, f"{where}; then {words}: {again.error}"
        others = self.others(results_of(place))
        assert not others, f"{where}; then {words}: another {others}"


def sampled(count: int, most: int | None) -> Iterable[int]:
    """From 1 to count, all or about as many as wanted, evenly."""
    if most is None or count <= most:
        return range(1, count + 1)
    return sorted({round(1 + k * (count - 1) / (most - 1)) for k in range(most)})


def tally(cases: Iterable[Callable[[], str]], jobs: int) -> Counter[str]:
    """How many cases ended how, so many at a time. AssertionError: each that went wrong."""
    found: Counter[str] = Counter()
    wrong: list[str] = []
    with ThreadPoolExecutor(jobs) as threads:
        for case in [threads.submit(case) for case in cases]:
            try:
                found[case.result()] += 1
            except Exception as error:  # what a file that is partial raises is h5py's own
                wrong.append(str(error) or repr(error))
    assert not wrong, f"{len(wrong)} of {sum(found.values()) + len(wrong)}\n" + "\n".join(wrong)
    return found


def faulty_calls(command: Command, how: str, folder: Path, shim: Path,
                 most: int | None = None, jobs: int = 1) -> Counter[str]:
    """A fault at every call of a command, or at so many."""
    faults = Faults(command, how, folder, shim)
    return tally((partial(faults.check, at) for at in sampled(faults.calls, most)), jobs)


# Damage.

def flipped(content: bytes, place: int) -> bytes:
    bit = 1 << (place * 5 % 8)
    return content[:place] + bytes([content[place] ^ bit]) + content[place + 1:]


def damages(content: bytes, most: int) -> Iterable[bytes]:
    """About as many flips and cuts, spread over a file."""
    for k in range(most):
        place = k * len(content) // most + k % 7
        if place < len(content):
            yield flipped(content, place)
            yield content[:place]


@dataclass(frozen=True)
class Damage:
    """A file that is damaged, and the call that then reads it."""

    name: str
    file: str
    words: tuple[str, ...]
    before: Callable[[Path], None]
    refused: bool = False  #: whatever is wrong; else the program must only not crash
    sealed: bool = False   #: what is not refused must hold what it held
    sound: bool = False    #: the results must be those of a file that is not damaged


def give(extension: str) -> Callable[[Path], None]:
    def make(folder: Path) -> None:
        assert call(folder, "specimen", "scene.toml", "-o", f"body.{extension}").status == 0
    return make


RESUME = ("run", "scene.toml", "-o", "out", "-q", "--resume")
DAMAGES = (
    Damage("checkpoint", "out/checkpoint.h5", RESUME, give_stopped_run, refused=True),
    Damage("frame", "out/trajectory/000001.h5", RESUME, give_stopped_run),
    Damage("index of frames", "out/trajectory.h5", RESUME, give_stopped_run, sound=True),
    Damage("body at rest", "out/trajectory/rest.h5", RESUME, give_stopped_run, sound=True),
    Damage("history", "out/history.csv", RESUME, give_stopped_run, refused=True),
    Damage("specimen .h5", "body.h5", ("info", "body.h5"), give("h5"), sealed=True),
    Damage("specimen .data", "body.data", ("info", "body.data"), give("data")),
    Damage("specimen .txt", "body.txt", ("info", "body.txt"), give("txt")),
    Damage("specimen .csv", "body.csv", ("info", "body.csv"), give("csv")),
    Damage("scene", "scene.toml", ("explain", "scene.toml", "--json"), lambda folder: None),
)


def damaged_files(damage: Damage, folder: Path, most: int, jobs: int = 1) -> Counter[str]:
    """Damages a file so many times; "refused" or "accepted"."""
    start = folder / "start"
    start.mkdir(parents=True)
    (start / "scene.toml").write_text(SCENE)
    damage.before(start)
    good = folder / "good"
    shutil.copytree(start, good)
    assert call(good, *damage.words).status == 0
    expected = results_of(good)

    def check(number: int, content: bytes) -> str:
        place = folder / str(number)
        shutil.copytree(start, place)
        (place / damage.file).write_bytes(content)
        done = call(place, *damage.words)
        where = f"{damage.name}, damage {number}: status {done.status}, {done.error}"
        assert done.status in (0, 1, 2), where
        assert done.status == 0 or done.error.startswith("error: "), where
        assert not damage.refused or done.status == 2, where
        assert not damage.sound or done.status == 0, where
        if damage.sound or (damage.sealed and done.status == 0):
            assert results_of(place) == expected, where
        shutil.rmtree(place)
        return "refused" if done.status else "accepted"

    whole = (start / damage.file).read_bytes()
    return tally((partial(check, *case) for case in enumerate(damages(whole, most))), jobs)


Work = Callable[[Path, int], Counter[str]]


def campaign(damages: int, shim: Path) -> Iterable[tuple[str, Work]]:
    """All of it: what is done and how it is done, in a folder, so many at a time."""
    for how in ("fail", "kill", "tear"):
        for command in COMMANDS:
            yield f"{how}, {command.name}", (lambda folder, jobs, command=command, how=how:
                                             faulty_calls(command, how, folder, shim, jobs=jobs))
    for damage in DAMAGES:
        yield f"damage, {damage.name}", (lambda folder, jobs, damage=damage:
                                         damaged_files(damage, folder, damages, jobs))


def attempt(label: str, work: Work, jobs: int) -> bool:
    """Does a part and prints its counts; whether nothing was wrong."""
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        try:
            counts = work(Path(folder) / "faults", jobs)
        except AssertionError as error:
            print(f"{label}: FAILED: {error}", flush=True)
            return False
    print(f"{label}: {counts.total()}: {dict(counts)}, {time.monotonic() - begin:.0f} s", flush=True)
    return True


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", help='such as "kill, run" or "damage"; default: all')
    parser.add_argument("--damages", type=int, default=400, help="places to damage in each file")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases side by side")
    words = parser.parse_args()
    with tempfile.TemporaryDirectory() as tools:
        parts = [(label, work) for label, work in campaign(words.damages, build_shim(Path(tools)))
                 if not words.parts or any(label.startswith(part) for part in words.parts)]
        good = [attempt(label, work, words.jobs) for label, work in parts]
    sys.exit(not all(good))


if __name__ == "__main__":
    main()
