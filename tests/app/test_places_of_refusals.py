# SPDX-License-Identifier: GPL-2.0-or-later
"""What cannot be made of a scene is refused with file and line, also where it shows only once the
specimen is there: each refusal begins with the place of the section or key that it is about."""

from __future__ import annotations

import pytest
from scene_parts import ALUMINIUM, CONDUCTING_ALUMINIUM, HELD, LOW_END, STIFF_BEAMS, grip

PACKING = '''[specimen]
shape = "box"
size = ["2 mm", "1 mm", "1 mm"]
elements = 60
'''
TWO_BODIES = '''[[body]]
name = "low"
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
elements = 30
[[body]]
name = "high"
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
elements = 30
shift = ["0.5 mm", "0 mm", "0 mm"]
'''
BEAMS = STIFF_BEAMS
HEAT = CONDUCTING_ALUMINIUM + 'law = "voronoi"\n'
RUN = "[run]\nsteps = 2\n"
CUT = '''[[specimen.cut]]
shape = { kind = "sphere", radius = "0.35 mm" }
centre = ["1 mm", "0.5 mm", "0.5 mm"]
'''


def at(scene: str, line: str, number: int = 1) -> int:
    """The number of a line, or of the second that reads so."""
    places = [k for k, text in enumerate(scene.splitlines(), 1) if text.startswith(line)]
    return places[number - 1]


#: (scene, the line that is at fault, the how many-th such line, words)
REFUSALS = {
    "elements too large": (PACKING.replace('"1 mm"]', '"1 um"]') + ALUMINIUM + BEAMS + RUN,
                           "elements = 60", 1, "take more elements"),
    "a body's elements too large": (TWO_BODIES.replace('"1 mm"]', '"1 um"]') + ALUMINIUM + BEAMS + RUN,
                                    "elements = 30", 1, '[[body]] "low" elements = 30'),
    "bodies that overlap": (TWO_BODIES + ALUMINIUM + BEAMS + RUN, "[[body]]", 1,
                            "bodies overlap at the start"),
    "bonded to nobody": (TWO_BODIES + 'bonded_to = ["middle"]\n' + ALUMINIUM + BEAMS + RUN,
                         "bonded_to", 1, "the name of another body"),
    "a second cut beside the body": (
        PACKING + CUT + CUT.replace('"1 mm"', '"9 mm"') + ALUMINIUM + BEAMS + RUN,
        "[[specimen.cut]]", 2, "it lies outside of the body"),
    "a file of nothing": ('[specimen]\nfile = "none.csv"\n' + ALUMINIUM + BEAMS + RUN,
                              'file = "none.csv"', 1, "none.csv: the file is empty"),
    "a grip of nothing": (PACKING + ALUMINIUM + BEAMS
                          + grip("left", 'lower = ["1 m", "any", "any"]', HELD) + RUN,
                          "region", 1, "holds no element"),
    "a grip of no such set": ('[specimen]\nfile = "body.h5"\n' + ALUMINIUM + BEAMS
                              + grip("left", 'set = "top"', HELD) + RUN,
                              "region", 1, 'no set "top"'),
    "grips that share": (PACKING + ALUMINIUM + BEAMS + grip("one", LOW_END, HELD)
                         + grip("two", LOW_END, HELD) + RUN, "[[grips]]", 2, "share elements"),
    "velocities of nothing": (
        PACKING + ALUMINIUM + BEAMS + '[[initial_velocities]]\nvelocity = ["1 m/s", "0 m/s", "0 m/s"]\n'
        'region = { lower = ["1 m", "any", "any"] }\n' + RUN, "region", 1, "holds no element"),
    "two materials of one element": (
        PACKING + 2 * (ALUMINIUM.replace("[material]", "[[material]]") + "region = { all = true }\n")
        + BEAMS + RUN, "region", 2, "lies in that of material 1, too"),
    "a temperature of nothing": (
        PACKING + HEAT + '[[temperatures]]\nname = "hot"\nvalue = "300 K"\n'
        'region = { lower = ["1 m", "any", "any"] }\n' + RUN, "region", 1, "holds no element"),
    "no such wall": (
        PACKING + HEAT + '[[temperatures]]\nname = "hot"\nvalue = "300 K"\n'
        'wall = "side"\n' + RUN, "wall", 1, "the body has no such wall"),
    "a source that misses": (
        PACKING + HEAT + '[[heat_sources]]\nname = "ball"\npower = "1 W"\n'
        'shape = { kind = "sphere", radius = "0.1 mm" }\ncentre = ["1 m", "0 m", "0 m"]\n' + RUN, "[[heat_sources]]", 1,
        "outside the body"),
    "a gauge beyond": (PACKING + ALUMINIUM + BEAMS
                       + '[gauge]\naxis = "x"\nlower = "1 mm"\nupper = "9 mm"\n' + RUN, "lower", 1,
                       "reaches beyond the body"),
    "a sensor far away": (PACKING + ALUMINIUM + BEAMS + '[[sensors]]\nname = "A"\n'
                          'point = ["1 m", "0 m", "0 m"]\nquantity = "position"\n' + RUN, "point", 1,
                          "away from the nearest element"),
    "a tool in the body": (
        PACKING + ALUMINIUM + BEAMS + '[[tools]]\nname = "ball"\nshape = "sphere"\nradius = "0.5 mm"\n'
        'origin = ["1 mm", "0.5 mm", "0.5 mm"]\n' + RUN, "[[tools]]", 1, "begins inside of the body"),
    "a step too long": (PACKING + ALUMINIUM + BEAMS + RUN + 'time_step = "1 s"\n', "time_step", 1,
                        "beyond the stable limit"),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_a_refusal_of_what_a_section_made_names_file_and_line(solidem, name):
    scene, line, number, words = REFUSALS[name]
    (solidem.folder / "none.csv").touch()
    if "body.h5" in scene:
        assert solidem("specimen", solidem.scene("body.toml", PACKING), "-o", "body.h5").returncode == 0
    done = solidem("run", solidem.scene("bad.toml", scene), "-o", "out")
    assert done.returncode == 2, done.stdout + done.stderr
    assert done.stderr.startswith(f"error: bad.toml:{at(scene, line, number)}: ["), done.stderr
    assert words in done.stderr


def test_solve_and_constants_name_the_place_too(solidem):
    body = PACKING + ALUMINIUM + BEAMS
    scene = body + grip("left", LOW_END, 'displacement = ["0 m", "free", "free"]') + RUN
    done = solidem("solve", solidem.scene("bad.toml", scene), "-o", "out")
    assert done.returncode == 2
    assert done.stderr.startswith(f'error: bad.toml:{at(scene, "[[grips]]")}: [[grips]] the body is not held')
    done = solidem("constants", solidem.scene("walls.toml", body + RUN))
    assert done.returncode == 2
    assert done.stderr.startswith("error: walls.toml:1: [specimen] periodic: elastic constants are"), done.stderr


def test_what_was_set_beside_the_file_is_named_itself(solidem):
    scene = solidem.scene("bad.toml", PACKING + ALUMINIUM + BEAMS + RUN)
    done = solidem("run", scene, "-o", "out", "--set", "specimen.mean_radius=\"5 mm\"", "--set", "specimen.elements=")
    assert done.returncode == 2
    assert "--set specimen.mean_radius" in done.stderr and "[specimen] mean_radius" in done.stderr, done.stderr
