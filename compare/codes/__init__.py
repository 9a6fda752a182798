# SPDX-License-Identifier: GPL-2.0-or-later
"""The codes that can be compared: one adaptor a file, all with the interface of base.Code."""

from __future__ import annotations

from compare.codes.base import Code
from compare.codes.calculix import Calculix
from compare.codes.lammps import Lammps
from compare.codes.liggghts import Liggghts
from compare.codes.standalone import Standalone
from compare.codes.statics import Statics
from compare.codes.yade import Yade


def all_codes() -> dict[str, Code]:
    """Every adaptor by the name that cases use."""
    codes: list[Code] = [Standalone(), Standalone("standalone-2", threads=2), Statics(), Liggghts(),
                         Liggghts("liggghts-2", ranks=2), Liggghts("liggghts-4", ranks=4),
                         Liggghts("liggghts-restart", restarts=True), Yade(), Calculix(), Lammps(),
                         Lammps("lammps-mie", "mie/cut")]
    return {code.name: code for code in codes}
