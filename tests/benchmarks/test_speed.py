# SPDX-License-Identifier: GPL-2.0-or-later
"""How the hot loops are held against the floors of a machine: what is computed from what was measured."""

from __future__ import annotations

import pytest

from benchmarks.speed import kernels

#: A machine whose figures are round.
TOLD = {"slot": {"beams": {"simple": 200, "divisions": 1, "roots": 1}},
        "threads": {"1": {"arithmetic": {"baseline": {"fused": 1e10, "divisions": 1e9, "roots": 5e8}},
                          "triad": {"1000000": 2e10}}}}
BODY = kernels.Body("beams", 1000, "", bonds=5000, bytes=1000000)


def test_floors_are_those_of_both_sides_of_a_bond_and_of_all_columns() -> None:
    # 100 fused of .1 ns; a division of 1 ns and a root of 2 ns go on beside them.
    assert kernels.arithmetic_floor(TOLD, BODY, "baseline", 1) == pytest.approx(20)
    slow = {**TOLD, "slot": {"beams": {"simple": 10, "divisions": 1, "roots": 1}}}
    assert kernels.arithmetic_floor(slow, BODY, "baseline", 1) == pytest.approx(6)
    assert kernels.bytes_floor(TOLD, BODY, 1) == pytest.approx(50e3 / 5000)
    assert set(kernels.ARITHMETIC) == set(kernels.EFFECTS)


def test_ratios_are_taken_within_a_repetition() -> None:
    """A machine that is twice as slow for a while changes no ratio."""
    def run(effect: str, instruction_set: str, threads: int, repetition: int, time: float) -> kernels.Measurement:
        slow = 2 if repetition else 1
        return kernels.Measurement(effect, 1000, instruction_set, threads, repetition, time * slow, 10.0 * slow,
                                   5.0 * slow)

    measured = [run(effect, name, threads, repetition, time * factor / threads)
                for effect, time in (("beams", 20.0), ("beams_flowing", 50.0))
                for name, factor in (("x86_64_v4", 1.0), ("baseline", 3.0))
                for threads in (1, 2) for repetition in (0, 1)]
    rows = [[cell.strip() for cell in line.strip("|").split("|")]
            for line in kernels.table(measured).splitlines()[2:]]
    told = {(row[0], row[2], row[3]): row[7:] for row in rows}
    assert told["beams", "AVX-512", "1"] == ["2.0", "", "", ""]
    assert told["beams", "baseline", "2"] == ["3.0", "3.00", "", "0.50"]
    assert told["beams_flowing", "baseline", "1"] == ["15.0", "3.00", "2.50", ""]
