# SPDX-License-Identifier: GPL-2.0-or-later
"""What a reader of the page needs: every plot, units, where it was made, and what agreement means."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

from compare import page
from compare.__main__ import main
from compare.row import Plot, Row, Series
from compare.units import unit_of, with_unit
from fake_codes import FakeCode, FakeStandalone, honest_result

CASES = Path(page.__file__).parent / "cases"


def row(variant: str, title: str, label: str, height: float, figure: str = "both") -> Row:
    """A row whose plot is one line at a height."""
    line = Series(label, np.array([0.0, 1.0]), np.full(2, height))
    plot = Plot(title, "time, s", "force, N", [line], figure=figure)
    return Row("bar", variant, "force", "A", "standalone", "", 0.0, 1.0, None, "", "why", plot)


def heights(plot: Plot) -> dict[str, float]:
    return {series.label: float(series.y[0]) for series in plot.series}


def test_plots_of_one_figure_are_all_in_its_picture(tmp_path: Path) -> None:
    rows = [row("slow", "slow bar", "ours", 1.0), row("fast", "fast bar", "ours", 2.0),
            row("other", "alone", "ours", 3.0, "alone")]
    both, alone = page.write_figures(rows, tmp_path)
    assert (both.name, alone.name) == ("both.png", "alone.png")
    wide, narrow = (plt.imread(path) for path in (both, alone))
    assert wide.shape[1] == 2 * narrow.shape[1]
    for half in np.array_split(wide, 2, axis=1):
        assert half[..., :3].min() < 0.5, "a plot is missing in the picture"


def test_lines_of_one_name_in_two_variants_are_both_drawn() -> None:
    rows = [row("slow", "bar", "ours", 1.0), row("fast", "bar", "ours", 2.0),
            row("same", "bar", "ours", 1.0)]
    (plot,) = page.merged_plots(rows)
    assert heights(plot) == {"ours": 1.0, "ours, fast": 2.0}


@pytest.mark.parametrize("count", [1, 2, 4])
def test_a_picture_has_a_panel_for_each_plot(count: int) -> None:
    plots = page.merged_plots([row(str(k), f"bar {k}", "ours", k) for k in range(count)])
    figure = page._figure(plots)
    drawn = [axes for part in ([figure] if count == 1 else figure.subfigs) for axes in part.axes]
    assert sorted(axes.get_title() for axes in drawn) == [f"bar {k}" for k in range(count)]
    assert {axes.get_xlabel() for axes in drawn} == {"time, s"}
    plt.close(figure)


def test_units_of_columns() -> None:
    assert with_unit("grip.right.force_x") == "grip.right.force_x, N"
    assert with_unit("sensor.A_fit.temperature") == "sensor.A_fit.temperature, K"
    assert with_unit("step") == "step"


def test_every_column_of_every_case_has_a_unit() -> None:
    names = set()
    for path in CASES.glob("*.toml"):
        for check in tomllib.loads(path.read_text())["check"]:
            options = check.get("options", {})
            names |= {options[key] for key in ("column", "against") if key in options}
            names |= {word[key] for word in check.get("for", {}).get("figure", [])
                      if isinstance(word, dict) for key in word if key == "column"}
    assert len(names) > 10
    assert [name for name in sorted(names) if unit_of(name) is None and name != "$column"] == []


def made_page(case_directory: Path, shared: bool) -> tuple[str, str, dict[str, object]]:
    """Page, Markdown and JSON of the rod in a code that shares laws, or does not."""
    output = case_directory / "results"
    other = FakeCode("other", lambda job, directory: honest_result("other"), shared=shared)
    codes = {"standalone": FakeStandalone(), "other": other}
    assert main(["--case-directory", str(case_directory), "--output", str(output)], codes) == 0
    return ((output / "index.html").read_text(), (output / "table.md").read_text(),
            json.loads((output / "table.json").read_text()))


@pytest.mark.parametrize("shared, word", [(True, "shared"), (False, "independent")])
def test_rows_tell_whether_the_law_is_independent(case_directory: Path, shared: bool,
                                                  word: str) -> None:
    html, markdown, table = made_page(case_directory, shared)
    assert [found["law"] for found in table["rows"]] == [word]
    assert f"<td>{word}</td>" in html
    assert f"| C | other | standalone | {word} |" in markdown


def test_page_tells_where_and_of_what_it_was_made(case_directory: Path) -> None:
    html, markdown, table = made_page(case_directory, True)
    made = table["made"]
    assert made["versions"] == {"standalone": "1.2.3", "other": "7.5"}
    assert re.fullmatch(r"\d{4}-\d\d-\d\d \d\d:\d\d UTC", made["date"])
    assert re.fullmatch(r"[0-9a-f]{12}(, with changes that are not committed)?|unknown: .*",
                        made["commit"])
    for text in (html, markdown):
        for words in (made["date"], made["commit"], made["machine"], "other: 7.5"):
            assert words in text


def test_page_begins_with_cases_by_codes(case_directory: Path) -> None:
    html, markdown, _ = made_page(case_directory, True)
    assert "| case | standalone | other |\n|---|---|---|\n| rod | 1/1 | 1/1 |" in markdown
    assert '<a href="#rod">A rod</a></td><td class="pass">1/1</td><td class="pass">1/1</td>' in html
    assert html.index('href="#rod"') < html.index('<h2 id="rod">')
