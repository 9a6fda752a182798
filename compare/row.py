# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of the tables, and plots beside them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from compare.result import Floats


@dataclass
class Series:
    """One line of a plot."""

    label: str
    x: Floats
    y: Floats
    style: str = "-"
    wide: bool = False  #: a broad pale line, for what others should lie on
    colour_of_previous: bool = False
    joined: bool = False  #: points of the same label in other rows belong to the same line
    band: Floats | None = None  #: from y to band is filled


@dataclass
class Plot:
    """What a plot shows; drawn by compare/page.py."""

    title: str
    x_label: str
    y_label: str
    series: list[Series]
    log_x: bool = False
    log_y: bool = False
    figure: str = ""  #: file name, when it is to be a picture of its own
    below: list[Series] = field(default_factory=list)  #: a smaller panel under it
    below_label: str = ""
    below_log: bool = False
    ticks: dict[float, str] = field(default_factory=dict)  #: words in place of numbers, horizontally


@dataclass
class Measured:
    """What a measure found."""

    error: float
    note: str = ""
    plot: Plot | None = None


@dataclass
class Row:
    """One line of the verification table."""

    case: str
    variant: str
    quantity: str
    label: str  #: class: A, P, C or R
    code: str
    reference: str
    error: float | None  #: None when it could not be measured
    tolerance: float
    wall_seconds: float | None  #: of the code's time steps
    note: str  #: why it failed, or what to know
    reason: str  #: why this tolerance
    plot: Plot | None = field(default=None, repr=False)
    law: str = ""  #: of class C: "independent", or "shared" when both compute it by the same source

    @property
    def passed(self) -> bool:
        """An error that is missing or not a number never passes."""
        return (self.error is not None and math.isfinite(self.error)
                and self.error <= self.tolerance)


@dataclass
class RunLine:
    """One line of the table of runs."""

    case: str
    variant: str
    code: str
    elements: int
    bonds: int
    steps: int
    wall_seconds: float | None  #: None: not a measurement
    nanoseconds_per_bond_step: float | None
