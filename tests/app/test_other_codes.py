# SPDX-License-Identifier: GPL-2.0-or-later
"""Other codes are told of each effect of the program, or refuse it by name."""

from __future__ import annotations

import json
import re

import pytest
from scene_parts import CONDUCTING_ALUMINIUM, STIFF_BEAMS, crystal

from contrib.explained import KNOWN_SECTIONS, parse_parameters

#: A body on which each effect can act that other codes are not told of.
BODY = (crystal("simple_cubic", 4, 3, 3)
        + CONDUCTING_ALUMINIUM.replace("\n", '\nexpansion_coefficient = "23e-6 1/K"\n', 1)
        + STIFF_BEAMS + "[plasticity]\nyield_strain = 0.002\n")


@pytest.fixture
def examples(solidem) -> dict[str, str]:
    """Of each section of the program, what makes it act."""
    found: dict[str, str] = {}
    for heading, text in re.findall(r"### `\[+([a-z_]+)\]+`(.*?)(?=\n### `\[+[a-z_]+\]+`|\Z)",
                                    solidem("keys").stdout, re.DOTALL):
        found[heading] = "".join(re.findall(r"```toml\n(.*?)```", text, re.DOTALL))
    return found


def test_what_other_codes_know_is_what_the_program_has(examples) -> None:
    assert len(examples) > len(KNOWN_SECTIONS)
    assert KNOWN_SECTIONS <= examples.keys(), "a section that the program does not have"


def test_a_scene_with_any_other_section_is_refused_by_its_name(solidem, examples) -> None:
    unknown = sorted(examples.keys() - KNOWN_SECTIONS)
    assert unknown
    for section in unknown:
        scene = solidem.scene("scene.toml", BODY + examples[section] + "[run]\nsteps = 1\n")
        done = solidem("explain", scene, "--json", "--quick")
        assert done.returncode == 0, done.stderr
        unsupported = parse_parameters(json.loads(done.stdout)).unsupported
        assert f"[{section}] is not understood" in unsupported, unsupported


def test_a_scene_of_known_sections_alone_is_not_refused_for_them(solidem) -> None:
    scene = solidem.scene("scene.toml", BODY + "[run]\nsteps = 1\n")
    done = solidem("explain", scene, "--json", "--quick")
    assert parse_parameters(json.loads(done.stdout)).unsupported == ()
