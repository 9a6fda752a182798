# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the points of a sweep side by side; what is there and was made the same way stays."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import threading
import time
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Sequence

from compare.sweep.scene_text import write_scene
from compare.sweep.sweep import Point

Say = Callable[[str], None]


class PointFailure(Exception):
    """A run that gave no result; the text is what the program said."""


@dataclass(frozen=True)
class Outcome:
    """What became of a point: the folder of its results, or why there is none."""

    point: Point
    folder: Path | None
    failure: str = ""
    seconds: float = 0.0
    was_there: bool = False


def fingerprint(program: Path) -> str:
    """Tells one build of the program from another."""
    return hashlib.sha256(program.read_bytes()).hexdigest()[:16]


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _read_json(path: Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return found if isinstance(found, dict) else {}
    except (OSError, ValueError):
        return {}


class Runner:
    """Runs scenes with one thread each in folders named by what the scenes say.

    A folder's record.json bears the program's fingerprint and is written last, so a run that was
    cut short has none; it goes on from its checkpoint if the same program made it. Points whose
    scenes are the same share a run, points whose bodies are the same share a specimen.
    """

    def __init__(self, program: Path, directory: Path, jobs: int = 1, any_program: bool = False,
                 say: Say = print):
        """Results go to directory/points, specimens to directory/specimens."""
        self.program, self.directory, self.jobs, self._say = program, directory, jobs, say
        self.any_program, self._stamp = any_program, fingerprint(program)
        self._running: set[subprocess.Popen[bytes]] = set()
        self._lock, self._stopping = threading.Lock(), False
        self._specimen_locks: dict[str, threading.Lock] = {}

    def run(self, points: Sequence[Point]) -> list[Outcome]:
        """The outcome of each point. On an interrupt the runs write their checkpoints and stop,
        and KeyboardInterrupt goes on to the caller."""
        texts = {id(point): write_scene(point.scene) for point in points}
        first = {_digest(texts[id(point)]): point for point in reversed(points)}
        done: dict[str, Outcome] = {}
        with ThreadPoolExecutor(max(1, self.jobs)) as pool:
            futures: dict[Future[Outcome], str] = {
                pool.submit(self._outcome, point, texts[id(point)]): key
                for key, point in reversed(first.items())}
            try:
                waiting = set(futures)
                while waiting:
                    ready, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                    for future in ready:
                        done[futures[future]] = future.result()
                        self._tell(future.result(), len(done), len(futures))
            except BaseException:
                self._stop()
                for future in futures:
                    future.cancel()
                raise
        return [Outcome(point, found.folder, found.failure, found.seconds, found.was_there)
                for point in points for found in [done[_digest(texts[id(point)])]]]

    def _tell(self, outcome: Outcome, number: int, count: int) -> None:
        point = outcome.point
        words = (f"FAILED: {outcome.failure}" if outcome.folder is None else
                 "was there" if outcome.was_there else f"{outcome.seconds:.1f} s")
        self._say(f"  {number}/{count}  {point.variation}: {point.setting.label}, "
                  f"specimen {point.seed}: {words}")

    def _outcome(self, point: Point, text: str) -> Outcome:
        start = time.perf_counter()
        folder = self.directory / "points" / _digest(text)
        if self._is_done(folder / "record.json", text):
            return Outcome(point, folder, was_there=True)
        try:
            self._make(point, folder, text)
            return Outcome(point, folder, seconds=time.perf_counter() - start)
        except (PointFailure, OSError) as failure:
            return Outcome(point, None, str(failure), time.perf_counter() - start)

    def _is_done(self, record: Path, text: str) -> bool:
        found = _read_json(record)
        return found.get("made_of") == _digest(text) and (
            self.any_program or found.get("program") == self._stamp)

    def _make(self, point: Point, folder: Path, text: str) -> None:
        begun = folder / "begun.json"
        stamp = {"made_of": _digest(text), "program": self._stamp}
        resumable = _read_json(begun) == stamp and (folder / "run" / "checkpoint.h5").exists()
        if not resumable:
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
        specimen = self._specimen(point)
        scene = {**point.scene, "specimen": {"file": str(specimen)}}
        (folder / "scene.toml").write_text(write_scene(scene), encoding="utf-8")
        begun.write_text(json.dumps(stamp), encoding="utf-8")
        start = time.perf_counter()
        self._call(["run", folder / "scene.toml", "--output", folder / "run", "--threads", "1",
                    "--quiet", *(["--resume"] if resumable else [])], folder / "run.log")
        if not _read_json(folder / "run" / "summary.json").get("completed"):
            raise PointFailure("the run stopped before its end")
        record = {**stamp, "variation": point.variation, "setting": point.setting.label,
                  "seed": point.seed, "seconds": time.perf_counter() - start,
                  "resumed": resumable}
        (folder / "record.json.new").write_text(json.dumps(record, indent=2), encoding="utf-8")
        os.replace(folder / "record.json.new", folder / "record.json")

    def _specimen(self, point: Point) -> Path:
        """The packing of a scene, made once for all points that have it."""
        if "file" in point.scene["specimen"]:
            return Path(point.scene["specimen"]["file"])
        text = write_scene({"specimen": point.scene["specimen"]})
        name = _digest(text)
        with self._lock:
            lock = self._specimen_locks.setdefault(name, threading.Lock())
        with lock:
            folder = self.directory / "specimens"
            folder.mkdir(parents=True, exist_ok=True)
            path, record = (folder / f"{name}.h5").resolve(), folder / f"{name}.json"
            if not (path.exists() and self._is_done(record, text)):
                record.unlink(missing_ok=True)
                (folder / f"{name}.toml").write_text(text, encoding="utf-8")
                self._call(["specimen", folder / f"{name}.toml", "--output", path, "--overwrite"],
                           folder / f"{name}.log")
                record.write_text(json.dumps({"made_of": _digest(text), "program": self._stamp}),
                                  encoding="utf-8")
        return path

    def _call(self, words: Sequence[str | Path], log: Path) -> None:
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}
        with log.open("wb") as file:
            with self._lock:
                if self._stopping:
                    raise PointFailure("not begun")
                # A group of its own: an interrupt at the terminal reaches it through us alone.
                process = subprocess.Popen([str(self.program), *map(str, words)], stdout=file,
                                           stderr=subprocess.STDOUT, env=environment,
                                           start_new_session=True)
                self._running.add(process)
            try:
                status = process.wait()
            finally:
                with self._lock:
                    self._running.discard(process)
        if status != 0:
            lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
            last = re.sub(r"\x1b\[[0-9;]*m", "", lines[-1]) if lines else "nothing was printed"
            raise PointFailure(f"exit status {status}: {last}")

    def _stop(self) -> None:
        """Ends the runs that this runner has started; they write their checkpoints."""
        with self._lock:
            self._stopping = True
            for process in self._running:
                process.send_signal(signal.SIGINT)
