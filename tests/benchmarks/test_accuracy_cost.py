# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against time: medians, fronts and knobs are right, and nothing that fails is dropped."""

from __future__ import annotations

import csv
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.accuracy_cost.front_page import measured, orders
from benchmarks.accuracy_cost.orders import order_of, table
from benchmarks.accuracy_cost.page import write_page
from benchmarks.accuracy_cost.results import Median, cheapest, front, gains, medians, own
from benchmarks.accuracy_cost.runs import Omission, Run, scene_of
from benchmarks.accuracy_cost.study import StudyError, read_study

ROOT = Path(__file__).resolve().parents[2]

SCENE = """\
title = "a rod"
[specimen]
shape = "box"
size = ["1 mm", "0.2 mm", "0.2 mm"]
elements = 60
seed = 1
[material]
density = "2790 kg/m^3"
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
[conduction]
law = "platonic"
initial_temperature = "298 K"
[[temperatures]]
name = "hot"
wall = "x_low"
value = "798 K"
[run]
duration = "5 ms"
time_step_ratio = 0.9
[output]
frames = 10
"""

STUDY = """\
title = "A short rod"
about = "One end is hot."
error = "root mean square of the elements' errors as part of 500 K"
scene = "rod.scene"
repetitions = 2
timeout = 60
not_covered = ["What nobody asked for."]
quick = { elements = 60 }

[options.solution]
kind = "rod"
axis = 0
length = 1e-3
density = 2790
specific_heat_capacity = 880
conductivity = 134
initial = 298
hot = 798

[[reading]]
name = "field"
measure = "field_error"
[reading.options]
half = { fourier = 0.136445 }
end = { fourier = 0.27289 }

[[axis]]
name = "law"
values = ["platonic", "voronoi"]
replace = { 'law = "platonic"' = 'law = "$value"' }
[[axis]]
name = "elements"
values = [60, 200]
replace = { "elements = 60" = "elements = $value" }
[[axis]]
name = "method"
[[axis.values]]
method = "explicit, 0.9"
integrator = "explicit"
[[axis.values]]
method = "explicit, 9"
integrator = "explicit"
replace = { "time_step_ratio = 0.9" = "time_step_ratio = 9" }

[[leave_out]]
where = { method = "explicit, 9", law = "platonic" }
why = "one law shows it"

[[move]]
words = "the Voronoi law"
axis = "law"
pairs = [["platonic", "voronoi"]]
"""


def run(law: str, elements: int, repetition: int, seconds: float, error: float) -> Run:
    """A run that was never made."""
    labels = {"law": law, "elements": str(elements), "method": "explicit, 0.9",
              "integrator": "explicit"}
    return Run("rod", labels, repetition, 1, elements, 10, 10, seconds, 0.5, 2.0,
               {"field": {"half": error, "end": error / 2}})


def rows(path: Path) -> list[dict[str, str]]:
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture
def study_file(tmp_path: Path) -> Path:
    (tmp_path / "rod.scene").write_text(SCENE)
    (tmp_path / "rod.toml").write_text(STUDY)
    return tmp_path / "rod.toml"


def test_the_front_holds_what_no_other_point_beats() -> None:
    points = [(1.0, 5.0), (2.0, 3.0), (2.0, 4.0), (3.0, 3.0), (4.0, 1.0), (0.5, 9.0), (5.0, 2.0)]
    assert front(points) == [True, True, False, False, True, True, False]


def test_equal_points_are_on_the_front_together_and_endless_times_never() -> None:
    assert front([(1.0, 1.0), (1.0, 1.0), (1.0, 2.0)]) == [True, True, False]
    assert front([(math.inf, 0.1), (1.0, 1.0)]) == [False, True]


def test_the_front_does_not_depend_on_the_order_of_points() -> None:
    points = [((17 * n) % 23 / 7, (11 * n) % 19 / 5) for n in range(60)]
    flags = front(points)
    assert [flag for _, flag in sorted(zip(points, flags))] == front(sorted(points))
    for (t, e), flag in zip(points, flags):
        beaten = any(a <= t and b <= e and (a, b) != (t, e) for a, b in points)
        assert flag is not beaten


def test_medians_are_over_repetitions_and_the_largest_error_counts() -> None:
    found = medians([run("platonic", 60, n, seconds, error) for n, seconds, error
                     in ((1, 3.0, 0.1), (2, 1.0, 0.5), (3, 2.0, 0.2))])
    assert len(found) == 1
    m = found[0]
    assert (m.runs, m.seconds, m.least_seconds, m.most_seconds) == (3, 2.0, 1.0, 3.0)
    assert (m.error, m.least_error, m.most_error) == (0.2, 0.1, 0.5)
    assert m.whole_seconds == 2.5 and m.on_front


def two_laws() -> list[Median]:
    return medians([run("platonic", 60, 1, 1.5, 0.08), run("voronoi", 60, 1, 3.5, 0.01),
                    run("platonic", 200, 1, 3.5, 0.04), run("voronoi", 200, 1, 7.5, 0.005)])


def test_a_knob_is_measured_between_points_that_differ_in_it_alone(study_file: Path) -> None:
    gain, = gains(read_study(study_file), two_laws())
    assert gain.pairs == 2
    assert gain.error_factor == pytest.approx(1 / 8)
    assert gain.whole_factor == pytest.approx(2)
    # Three halvings of the error for twice the time.
    assert gain.price == pytest.approx(2 ** (1 / 3))


def test_the_cheapest_point_keeps_the_error_asked_for() -> None:
    points = two_laws()
    found = cheapest(points, 0.02)
    assert found is not None and found.labels["law"] == "voronoi" and found.elements == 60
    assert cheapest(points, 0.001) is None


def test_what_two_threads_give_is_a_knob_and_no_front(study_file: Path) -> None:
    study_file.write_text(STUDY.replace('''[[leave_out]]''', '''[[axis]]
name = "code"
values = ["standalone", "standalone-2"]

[[leave_out]]''', 1) + '''
[[move]]
words = "two threads in place of one"
axis = "code"
pairs = [["standalone", "standalone-2"]]
''')
    study = read_study(study_file)
    one, two = (replace(made, labels=made.labels | {"code": code})
                for made, code in ((run("platonic", 60, 1, 4.0, 0.1), "standalone"),
                                   (run("platonic", 60, 1, 2.0, 0.1), "standalone-2")))
    points = medians([two, one])
    assert [m.labels["code"] for m in points if m.on_front] == ["standalone"] == [
        m.labels["code"] for m in own(points)]
    gain, = gains(study, points)
    assert gain.words == "two threads in place of one" and gain.error_factor == 1
    assert gain.steps_factor == 0.5


def test_what_is_left_out_and_what_failed_is_on_the_page(study_file: Path, tmp_path: Path) -> None:
    study = read_study(study_file)
    lost = Omission("rod", {"law": "voronoi", "elements": "200"}, 1, "the machine was on fire")
    write_page(tmp_path, [study], two_laws(), [lost], ["Machine: none."])
    for name in ("page.md", "index.html"):
        text = (tmp_path / name).read_text()
        assert "the machine was on fire" in text
        assert "one law shows it" in text and "What nobody asked for." in text
    assert (tmp_path / "rod.png").stat().st_size > 1000


def test_a_rule_without_a_reason_is_refused(study_file: Path) -> None:
    study_file.write_text(STUDY.replace('why = "one law shows it"', 'why = " "'))
    with pytest.raises(StudyError, match="without a reason"):
        read_study(study_file)


def test_a_rule_about_an_unknown_setting_is_refused(study_file: Path) -> None:
    study_file.write_text(STUDY.replace('law = "platonic" }\nwhy', 'law = "platnic" }\nwhy'))
    with pytest.raises(StudyError, match="platnic.*known: platonic, voronoi"):
        read_study(study_file)


@pytest.mark.parametrize("name", sorted(
    path.stem for path in (ROOT / "benchmarks" / "accuracy_cost" / "studies").glob("*.toml")))
def test_scenes_of_the_studies_have_the_words_that_are_replaced(name: str) -> None:
    study = read_study(ROOT / "benchmarks" / "accuracy_cost" / "studies" / f"{name}.toml")
    scenes = {scene_of(study, point, 2) for point in study.combinations()}
    # Codes and instruction sets are the only axes that leave the scene as it is.
    outside = math.prod(len(study.axes[a]) for a in ("code", "instructions") if a in study.axes)
    assert len(scenes) == len(study.combinations()) / outside


def test_a_real_study_from_end_to_end(study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "results"
    command = [sys.executable, "-m", "benchmarks.accuracy_cost", str(study_file), "--output",
               str(output)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=120,
                          check=False)
    assert done.returncode == 1, done.stderr  # the step that is too long is refused
    runs, points, lost = (rows(output / f"{name}.csv") for name in ("runs", "points", "omissions"))
    assert len(runs) == 8 and len(points) == 4 and len(lost) == 4
    assert all(r["law"] == "voronoi" and r["method"] == "explicit, 9" for r in lost)
    assert all("time step" in r["reason"] for r in lost)
    assert "time step" in (output / "page.md").read_text()
    assert all(float(r["steps_seconds"]) > 0 and float(r["set_up_seconds"]) > 0 for r in runs)
    assert sorted(int(r["order"]) for r in runs) != [int(r["order"]) for r in sorted(
        runs, key=lambda r: (r["law"], r["elements"], r["repetition"]))]
    error = {(p["law"], p["elements"]): float(p["error"]) for p in points}
    for elements in ("60", "200"):
        assert 0 < error["voronoi", elements] < 0.02 < error["platonic", elements]
    again = subprocess.run([*command, "--resume"], cwd=ROOT, capture_output=True, text=True,
                           timeout=120, check=False)
    assert again.returncode == 1
    assert rows(output / "runs.csv") == runs


BAR = """\
title = "a bar"
[specimen]
shape = "box"
size = ["1 mm", "0.4 mm", "0.4 mm"]
elements = 60
seed = 1
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.3
[[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1 }
velocity = ["2 m/s", "0 m/s", "0 m/s"]
[run]
duration = "2 us"
time_step_of_limit = 0.5
observe_every = 1  # so that what is read between rows errs by less than the steps
[output]
frames = 1
"""

BAR_STUDY = """\
title = "A short bar"
about = "It is pulled."
error = "force against the finest step"
scene = "bar.scene"
repetitions = 2
timeout = 60
markers = "step"
[reference.fine]
labels = { step = "0.1" }
replace = { "time_step_of_limit = 0.1" = "time_step_of_limit = 0.02" }
[reference.large]
labels = { elements = 200, step = "0.5" }
own_specimen = false
[[reading]]
name = "force"
measure = "curve_error"
reference = "fine"
[reading.options]
force = { x = "time", y = "grip.right.force_x", from = 0.05, to = 1.0 }
[[reading]]
name = "modulus"
measure = "slope_error"
reference = "large"
panel = true
[reading.options]
slope = { x = "grip.right.displacement_x", y = "grip.right.force_x", from = 0.3, to = 1.0 }
[[axis]]
name = "law"
values = ["beams"]
[[axis]]
name = "elements"
values = [60, 200]
replace = { "elements = 60" = "elements = $value" }
[[axis]]
name = "step"
values = ["0.5", "0.1", "0.9"]
replace = { "time_step_of_limit = 0.5" = "time_step_of_limit = $value" }
[[move]]
words = "a finer step"
axis = "step"
pairs = [["0.9", "0.5"], ["0.5", "0.1"]]
"""


@pytest.fixture
def bar_file(tmp_path: Path) -> Path:
    (tmp_path / "bar.scene").write_text(BAR)
    (tmp_path / "bar.toml").write_text(BAR_STUDY)
    return tmp_path / "bar.toml"


def test_a_reference_keeps_what_it_does_not_name(bar_file: Path) -> None:
    study = read_study(bar_file)
    for point in study.points():
        fine, large = (study.reference_of(point, name) for name in ("fine", "large"))
        assert fine.labels == point.labels | {"step": "0.1"}
        assert large.labels == {"law": "beams", "elements": "200", "step": "0.5"}
        assert fine.replace["time_step_of_limit = 0.1"] == "time_step_of_limit = 0.02"


@pytest.mark.parametrize("old, new, message", [
    ('reference = "fine"', 'reference = "coarse"', "known: fine, large"),
    ('labels = { step = "0.1" }', 'labels = { step = "0.3" }', "known: 0.1, 0.5, 0.9"),
    ('markers = "step"', 'markers = "colour"', "markers = 'colour'")])
def test_a_wrong_reference_is_refused(bar_file: Path, old: str, new: str, message: str) -> None:
    bar_file.write_text(BAR_STUDY.replace(old, new))
    with pytest.raises(StudyError, match=message):
        read_study(bar_file)


def test_a_bar_against_its_finest_step_and_a_larger_body(bar_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "results"
    command = [sys.executable, "-m", "benchmarks.accuracy_cost", str(bar_file), "--output",
               str(output)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=120,
                          check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    points = rows(output / "points.csv")
    error = {(p["reading"], p["elements"], p["step"]): float(p["error"]) for p in points}
    for elements in ("60", "200"):
        # The scheme is of second order, and shares of the limit are what they say.
        coarse, middle, fine = (error["force", elements, s] for s in ("0.9", "0.5", "0.1"))
        assert fine < 0.2 * middle < 0.2 * coarse
    runs = {(r["elements"], r["step"], r["repetition"]): int(r["steps"])
            for r in rows(output / "runs.csv")}
    for elements in ("60", "200"):
        for repetition in ("1", "2"):
            assert runs[elements, "0.1", repetition] == pytest.approx(
                9 * runs[elements, "0.9", repetition], rel=0.1)
    # The large body is the first repetition's own specimen: there the error is zero.
    first = [float(r["slope"]) for r in rows(output / "runs.csv")
             if (r["reading"], r["elements"], r["step"], r["repetition"])
             == ("modulus", "200", "0.5", "1")]
    assert first == [0.0]
    assert (output / "bar_2.png").stat().st_size > 1000
    assert "bar_2.png" in (output / "page.md").read_text()


def points_of_order(order: float, reference: float) -> list[dict[str, str]]:
    """Errors that fall as the size to that power, against a body that errs itself; times as elements to the
    power 4/3; other codes and worse ways do not count."""
    points = []
    for elements in (200, 600, 1800, 5400):
        error = elements**(-order / 3) - reference**(-order / 3)
        right = {"code": "standalone", "elements": str(elements), "error": str(error),
                 "seconds": str(elements**(4 / 3))}
        points += [right, {**right, "error": "1", "seconds": "0.1"}, {**right, "code": "yade",
                                                                     "error": "0"}]
    return points


@pytest.mark.parametrize("reference", [math.inf, 12000.0])
@pytest.mark.parametrize("order", [1.0, 1.5])
def test_orders_are_those_of_the_errors(order: float, reference: float) -> None:
    points = points_of_order(order, reference)
    found = order_of("bars", "", points, reference)
    assert found is not None
    assert found.order == pytest.approx(order, abs=0.02) and found.spread < 0.1
    assert found.time_exponent == pytest.approx(4 / 3)
    assert order_of("bars", "", points[:6]) is None
    (row,) = table({"elastic": [found, replace(found, study="rods", order=order + 0.5)]})
    assert row["studies"] == "bars and rods"
    assert float(row["order"]) == pytest.approx(order + 0.25, abs=0.02)
    assert float(row["spread"]) >= 0.25


def test_the_table_of_studies_is_that_of_the_tables_in_docs() -> None:
    """Whoever changes a points.csv makes the front page anew."""
    with (ROOT / "python" / "solidem" / "studies.csv").open(encoding="utf-8") as file:
        assert list(csv.DictReader(file)) == table(orders(measured()))
