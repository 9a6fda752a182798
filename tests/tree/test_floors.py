# SPDX-License-Identifier: GPL-2.0-or-later
"""The tree is built as docs/architecture.md says: nobody reaches up, every source is signed."""

import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STANDALONE = ROOT / "standalone"
INCLUDE = re.compile(r'#include "([a-z_]+)/')


def floors() -> dict[str, int]:
    """Room -> floor, from the table in the architecture page."""
    rows = re.findall(r"^\| (\d) \| `(\w+)/` \|", (ROOT / "docs/architecture.md").read_text(),
                      re.MULTILINE)
    return {room: int(floor) for floor, room in rows}


def sources(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.suffix in (".hpp", ".cpp")]


def rooms_of(path: Path) -> set[str]:
    return set(INCLUDE.findall(path.read_text()))


def test_the_page_knows_every_room_that_has_sources() -> None:
    rooms = {folder.name for folder in STANDALONE.iterdir() if folder.is_dir() and sources(folder)}
    assert rooms == set(floors())


def test_no_room_includes_a_higher_floor() -> None:
    floor = floors()
    reaching_up = [f"{path.relative_to(ROOT)} includes {other}/"
                   for room in floor for path in sources(STANDALONE / room)
                   for other in rooms_of(path) if floor.get(other, 9) > floor[room]]
    assert not reaching_up


def test_laws_need_nothing_but_laws_and_small_standard_headers() -> None:
    allowed = {"cmath", "array", "type_traits", "algorithm", "cstddef", "utility", "variant"}
    for path in sources(STANDALONE / "laws"):
        assert rooms_of(path) <= {"laws"}, path
        assert set(re.findall(r"#include <([^>]+)>", path.read_text())) <= allowed, path


def test_parallel_regions_stand_where_errors_come_out_of_them() -> None:
    regions = {path.relative_to(STANDALONE).as_posix() for path in sources(STANDALONE)
               if "#pragma omp" in path.read_text()}
    assert regions == {"model/blocks.hpp"}


def test_every_source_names_its_licence() -> None:
    names = subprocess.run(["git", "ls-files", "*.cpp", "*.hpp", "*.h", "*.py"], cwd=ROOT,
                           check=True, text=True, capture_output=True).stdout.split()
    unsigned = [name for name in names if (ROOT / name).exists()
                and "SPDX-License-Identifier: GPL-2.0-or-later" not in
                "\n".join((ROOT / name).read_text().splitlines()[:6])
                and "GNU General Public License" not in (ROOT / name).read_text()]
    assert not unsigned


def test_links_in_the_documents_lead_somewhere() -> None:
    names = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, check=True, text=True,
                           capture_output=True).stdout.split()
    # What stands in a block of code is no link.
    pages = {name: re.sub(r"^```.*?^```$", "", (ROOT / name).read_text(),
                          flags=re.MULTILINE | re.DOTALL) for name in names if (ROOT / name).exists()}
    dead = [f"{name}: {target}" for name, page in pages.items()
            for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page)
            if not target.startswith("http") and not ((ROOT / name).parent / target).exists()]
    assert not dead


def test_no_two_rooms_include_each_other_by_any_way() -> None:
    includes = {folder.name: set().union(*(rooms_of(path) for path in sources(folder))) - {folder.name}
                for folder in STANDALONE.iterdir() if folder.is_dir() and sources(folder)}
    while free := {room for room, others in includes.items() if not others & set(includes)}:
        includes = {room: others for room, others in includes.items() if room not in free}
    assert not includes, f"a circle among {sorted(includes)}"
