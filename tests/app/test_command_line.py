# SPDX-License-Identifier: GPL-2.0-or-later
"""What stands round a run: values given beside the file, closing lines, figures for programs,
misspelt words, colours, the manual, completion."""

from __future__ import annotations

import csv
import json
import os
import pty
import re
import shutil
import subprocess

import pytest

SHORT = "steps = 2000"


@pytest.fixture
def short(bar: str) -> str:
    return bar.replace(SHORT, "steps = 200")


def summary(solidem, folder: str) -> dict:
    return json.loads((solidem.folder / folder / "summary.json").read_text())


def test_a_value_given_beside_the_file_is_that_of_a_changed_file(solidem, short):
    scene = solidem.scene("bar.toml", short)
    changed = solidem.scene("changed.toml", short.replace("3.5 TPa", "3 TPa"))
    words = ("--set", "beams.young_modulus=3 TPa", "--set=grips.right.velocity.0=1 m/s")
    assert solidem("run", scene, "-o", "words", *words).returncode == 0
    assert solidem("run", changed, "-o", "file").returncode == 0
    histories = [(solidem.folder / name / "history.csv").read_bytes() for name in ("words", "file")]
    assert histories[0] == histories[1]
    assert summary(solidem, "words")["set"] == ["beams.young_modulus=3 TPa",
                                                "grips.right.velocity.0=1 m/s"]
    assert "set" not in summary(solidem, "file")


def test_a_wrong_value_is_named_as_from_the_command_line(solidem, short):
    scene = solidem.scene("bar.toml", short)
    done = solidem("explain", scene, "--set", "beams.young_modulus=3 kg")
    assert done.returncode == 2
    assert done.stderr.startswith('error: --set beams.young_modulus=3 kg: [beams] young_modulus = ')


def test_a_run_with_other_values_does_not_go_on_without_them(solidem, short):
    scene = solidem.scene("bar.toml", short)
    words = ("--set", "beams.young_modulus=3 TPa")
    assert solidem("run", scene, "-o", "run", *words).returncode == 0
    longer = ("-o", "run", "--resume", "--set", "run.steps=300")
    refused = solidem("run", scene, *longer)
    assert refused.returncode == 2 and "beams.young_modulus" in refused.stderr
    assert solidem("run", scene, *longer, *words).returncode == 0
    assert summary(solidem, "run")["steps"] == 300


def test_a_run_closes_with_what_came_out(solidem, short):
    scene = solidem.scene("bar.toml", short)
    done = solidem("run", scene, "-o", "results", "-q")
    lines = done.stdout.splitlines()
    with open(solidem.folder / "results" / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    peak = max(rows, key=lambda row: abs(float(row["gauge.stress"])))
    told = re.fullmatch(r"peak stress (\S+) ([kMG]?)Pa at a strain of (\S+), at the end.*", lines[-2])
    assert told, lines
    scale = {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[told[2]]
    assert float(told[1]) * scale == pytest.approx(float(peak["gauge.stress"]), rel=1e-3)
    assert float(told[3]) == pytest.approx(float(peak["gauge.strain"]), rel=1e-3)
    assert summary(solidem, "results")["peak"]["gauge.stress"] == float(peak["gauge.stress"])
    assert lines[-3].startswith("done: ") and "200 steps in " in lines[-3]
    assert "results/history.csv" in lines[-1] and "results/trajectory.xdmf" in lines[-1]


def test_a_run_that_breaks_tells_how_many_bonds_broke(solidem, short):
    scene = solidem.scene("torn.toml", short + '[rupture]\nelastic_strain = 1e-5\n')
    done = solidem("run", scene, "-o", "results", "-q")
    broken = summary(solidem, "results")["bonds_broken"]
    assert broken > 0 and f"{broken} bonds broken, " in done.stdout


def test_figures_for_programs_are_json_and_nothing_else(solidem, short):
    scene = solidem.scene("bar.toml", short)
    made = json.loads(solidem("specimen", scene, "-o", "bar.h5", "--json").stdout)
    read = json.loads(solidem("info", "bar.h5", "--json").stdout)
    assert {**made, "notes": []} == {**read, "notes": []}
    assert read["elements"] * read["report"]["coordination_number"] / 2 == pytest.approx(read["bonds"])
    solved = json.loads(solidem("solve", scene, "-o", "rest", "--json").stdout)
    assert solved == summary(solidem, "rest")
    laws = json.loads(solidem("law", "list", "--json").stdout)
    mie = {law["name"]: law for law in laws}["mie"]
    assert {"name", "unit", "is_integer", "meaning"} == set(mie["parameters"][0])
    plot = json.loads(solidem("law", "plot", "mie", "energy=0.1 mJ", "repulsive_exponent=8",
                              "attractive_exponent=4", "-o", "law", "--json").stdout)
    # K = m n E / δ_eq², of the standard distance.
    assert plot["laws"][0]["stiffness"] == pytest.approx(8 * 4 * 1e-4 / 0.3e-3**2)
    assert all((solidem.folder / name).exists() for name in plot["files"])


@pytest.mark.parametrize(("words", "meant"), [
    (["rnu", "bar.toml"], "run"), (["law", "plto"], "plot"),
    (["run", "bar.toml", "--ouput", "x"], "--output"), (["--versoin"], "--version"),
    (["info", "bar.h5", "--jsn"], "--json")])
def test_the_nearest_word_is_told_for_a_misspelt_one(solidem, words, meant):
    done = solidem(*words)
    assert done.returncode == 2
    assert done.stderr.startswith("error: ") and f"(did you mean {meant}?)" in done.stderr


def test_a_missing_word_is_told_with_where_to_look(solidem):
    done = solidem("run")
    assert done.returncode == 2 and "scene is required; see solidem run --help" in done.stderr
    done = solidem("law")
    assert done.returncode == 2 and "expected one of list, plot" in done.stderr


def on_terminal(solidem, *words: str, **environment: str) -> str:
    """What a call shows on a terminal."""
    mine, its = pty.openpty()
    kept = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
    with subprocess.Popen([str(solidem.path), *words], cwd=solidem.folder, stdout=its, stderr=its,
                          env={**kept, "TERM": "xterm", **environment}) as process:
        os.close(its)
        shown = b""
        try:
            while part := os.read(mine, 4096):
                shown += part
        except OSError:  # the other end was closed
            pass
        process.wait(timeout=60)
    os.close(mine)
    return shown.decode()


def test_commands_in_python_tell_what_is_missing(solidem, tmp_path):
    """As where there is no Python, and where its module is not installed."""
    program = tmp_path / "solidem"  # beside which no module stands
    shutil.copy(solidem.path, program)
    (tmp_path / "empty").mkdir()
    for path, said in ((tmp_path / "empty", "solidem view needs Python: python3 cannot be called"),
                       ("/usr/bin:/bin", "solidem view needs Python's solidem")):
        done = subprocess.run([program, "view", "results"], text=True, capture_output=True, check=False,
                              env={"VIRTUAL_ENV": "/", "PATH": str(path)})
        assert done.returncode == 1 and f"error: {said}" in done.stderr, done.stderr


def test_colours_are_for_terminals_and_can_be_switched_off(solidem):
    coloured = on_terminal(solidem, "run", "missing.toml")
    assert "\x1b[" in coloured
    plain = re.sub("\x1b\\[[0-9;]*m", "", coloured)
    assert on_terminal(solidem, "run", "missing.toml", NO_COLOR="1") == plain
    assert on_terminal(solidem, "run", "missing.toml", TERM="dumb") == plain
    assert on_terminal(solidem, "run", "missing.toml", NO_COLOR="") == coloured
    assert solidem("run", "missing.toml").stderr == plain.replace("\r\n", "\n")


def test_the_version_tells_the_build(solidem):
    version = solidem("--version").stdout
    assert re.match(r"\d+\.\d+\.\d+ \(", version)
    assert re.search(r"(g\+\+|clang) \d+\.\d+", version)
    assert "baseline" in version


def commands(solidem) -> list[list[str]]:
    """All commands, from the words of help."""
    def below(*words: str) -> list[str]:
        text = solidem(*words, "--help").stdout
        part = text.split("Subcommands:")
        return re.findall(r"^  (\w+) ", part[1], re.MULTILINE) if len(part) > 1 else []

    found = []
    for name in below():
        further = below(name)
        found += [[name, last] for last in further] if further else [[name]]
    return found


def test_the_manual_knows_every_command_and_option(solidem):
    page = solidem("manual").stdout.replace("\\-", "-")
    for words in commands(solidem):
        section = page.split(f".SS \\fBsolidem {' '.join(words)}\\fR")
        assert len(section) == 2, words
        text = section[1].split(".SS ")[0]
        if words[0] in ("view", "converge", "advise"):  # whose words Python knows
            assert f"solidem {words[0]} --help" in text
            continue
        for option in re.findall(r"(?<![\w-])--[a-z-]+", solidem(*words, "--help").stdout):
            if option != "--help":
                assert f"\\fB{option}\\fR" in text, (words, option)


def test_the_manual_is_set_without_complaint(solidem):
    if shutil.which("groff") is None:
        pytest.fail("groff is missing; tests/setup installs it")
    done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-rLL=100n", "-P-cbou"], check=False, text=True,
                          input=solidem("manual").stdout, capture_output=True)
    assert done.returncode == 0 and not done.stderr
    assert "--overwrite" in done.stdout


@pytest.mark.parametrize(("words", "expected"), [
    ("exp", {"explain"}), ("law pl", {"plot"}), ("run --res", {"--resume"}),
    ("law plot --eq", {"--equilibrium"}), ("info spec", {"specimen.h5"})])
def test_bash_completes_commands_options_and_files(solidem, words, expected):
    (solidem.folder / "specimen.h5").touch()
    script = solidem("completion").stdout + f"""
COMP_WORDS=(solidem {words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
_solidem; printf '%s\\n' "${{COMPREPLY[@]}}"
"""
    done = subprocess.run(["bash", "-u"], check=True, text=True, input=script, capture_output=True,
                          cwd=solidem.folder)
    assert set(done.stdout.split()) == expected
