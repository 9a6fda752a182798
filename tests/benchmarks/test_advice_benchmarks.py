# SPDX-License-Identifier: GPL-2.0-or-later
"""The scenes of the benchmarks of advice and of effects can be used."""

from __future__ import annotations

import os
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, os.environ.get("SOLIDEM_PYTHON", str(ROOT / "build" / "release" / "python")))
from benchmarks.advice.__main__ import SCENES, Row, asked_of, told  # noqa: E402
from benchmarks.effects.__main__ import write as write_effects  # noqa: E402
from benchmarks.effects.scenes import (BEAM_EFFECTS, BEAMS, CENTRAL, CENTRAL_EFFECTS,  # noqa: E402
                                       SPECIMEN, scene)
from solidem import Scene  # noqa: E402
from solidem.refinement import refinement_of  # noqa: E402
from solidem.studies import kind_of  # noqa: E402


def test_eight_scenes_of_each_kind_and_none_of_a_study() -> None:
    paths = sorted(SCENES.glob("*.toml"))
    assert len(paths) == 8
    kinds = set()
    for path in paths:
        tables = Scene(path).tables
        kinds.add(kind_of(tables))
        assert refinement_of(tables).bodies and asked_of(path)[0]
    assert kinds == {"heat", "elastic", "plastic", "coupled", "contact"}
    titles = {tomllib.loads(path.read_text())["title"]
              for path in (ROOT / "benchmarks" / "accuracy_cost" / "scenes").glob("*.toml")}
    assert not titles & {Scene(path).title for path in paths}


def test_a_broken_promise_is_told() -> None:
    row = Row("bar", "elastic", "gauge.stress", 0.01, True, "body", 0.01, 0.004, 1000, "2 × 4000", 0.001,
              0.02, "broken", 10.0, 2.0, 4.0, 2.0, 30_000.0, 60.0)
    assert "1000 elements, promised 1 %, error 2 % ± 0.1 % broken; foretold 2 s, took 4 s (× 2.00)" in told(row)


def test_effects_that_are_not_measured_anew_stay(tmp_path: Path) -> None:
    def row(effect: str, ratio: float) -> dict[str, object]:
        return {"code": "standalone", "base": "beams", "effect": effect, "time_ratio": ratio}

    table = tmp_path / "effects.csv"
    write_effects([row("off again", 1.1), row("gravity", 1.2)], table)
    write_effects([row("off again", 1.0)], table)
    assert table.read_text().splitlines()[1:] == ["standalone,beams,off again,1", "standalone,beams,gravity,1.2"]


@pytest.mark.parametrize(("base", "effects"), [(BEAMS, BEAM_EFFECTS), (CENTRAL, CENTRAL_EFFECTS)])
def test_every_effect_can_be_switched_on(base: str, effects: dict[str, str], tmp_path: Path) -> None:
    body = SPECIMEN.replace("$elements", "60")
    for name, effect in effects.items():
        text = scene(base, effect, 5).replace('[specimen]\nfile = "bar.h5"\n', body)
        assert Scene(text, folder=tmp_path).run(tmp_path / "run", overwrite=True).summary["completed"], name
