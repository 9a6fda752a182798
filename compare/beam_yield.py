# SPDX-License-Identifier: GPL-2.0-or-later
"""One beam between two spheres that flows along a path, against the stress–strain curve it stands
for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from compare.beam_modes import axes_of, beam_of, loads_of, modes
from compare.codes.base import TwoSpheres
from compare.measures import measure
from compare.references import cyclic_stress, scaled_offset_stress
from compare.result import CodeFailure, Floats
from compare.row import Measured, Plot, Series
from compare.runs import View
from contrib.prepared import Plasticity

#: Largest change of strain between two poses, over the yield strain.
STEP = 0.05


def _path(points: list[float]) -> Floats:
    """Strains from zero to each of the points in turn, over the yield strain."""
    legs = [np.linspace(a, b, int(np.ceil(abs(b - a) / STEP)) + 1)[1:]
            for a, b in zip([0.0, *points], points)]
    return np.concatenate(legs)


def _per_strain(beam: TwoSpheres, mode: str, length: float) -> float:
    """Amplitude of the mode that strains the edge of the section by 1."""
    if mode == "tension":
        return 1.0
    if mode == "bending":
        return length / (2 * beam.beam_radius)
    if mode == "torsion":
        return length * beam.young_modulus / (np.sqrt(3) * beam.shear_modulus * beam.beam_radius)
    raise CodeFailure(f"mode {mode!r}; allowed: tension, bending, torsion")


def _stress(beam: TwoSpheres, mode: str, loads: Floats, axes: Floats) -> Floats:
    """(M,) equivalent stress over E, of the sign of the loads."""
    r, second = beam.beam_radius, np.pi * beam.beam_radius**4 / 4
    x, _, z = axes
    if mode == "tension":
        return np.asarray(loads[:, 0] @ x / (np.pi * r**2) / beam.young_modulus)
    if mode == "bending":
        return np.asarray(loads[:, 2] @ z * r / second / beam.young_modulus)
    return np.asarray(np.sqrt(3) * loads[:, 2] @ x * r / (2 * second) / beam.young_modulus)


@measure
def yield_along_path(view: View) -> Measured:
    """Largest error of the stress along a path, over the yield stress.

    Against σ = F/S, M r/I or √3 T r/I_0 of the law's one-dimensional curve: by radial return with
    isotropic hardening, or the scaled offset. Options: `mode` (tension, bending, torsion), `points`
    (strains to go through, over the yield strain), `plasticity` = { law, yield_strain,
    hardening_ratio }.
    """
    beam, mode = beam_of(view), view.option("mode")
    flow = Plasticity(**view.option("plasticity"))
    axes, length = axes_of(beam)
    path = _path(view.option("points"))
    strain = flow.yield_strain * path
    size = strain * _per_strain(beam, mode, length)
    motions = size[:, None, None] * modes(axes, length)[mode]
    loads = loads_of(view, replace(beam, plasticity=flow), motions, f"{mode} {flow.law}")
    found = _stress(beam, mode, loads, axes) / flow.yield_strain
    curve = scaled_offset_stress if flow.law == "scaled-offset" else cyclic_stress
    expected = curve(strain, flow.yield_strain, flow.hardening_ratio) / flow.yield_strain
    if not np.abs(expected).max() >= 1:
        raise CodeFailure("the path never yields")
    plot = Plot(f"one beam: {mode}, {flow.law}", "strain / yield strain", "stress / yield stress",
                [Series("exact", path, expected, "k-", wide=True),
                 Series(view.check.code, path, found, "--")])
    return Measured(float(np.abs(found - expected).max()),
                    f"{len(path)} poses, stress from {found.min():.4g} to {found.max():.4g} of the "
                    "yield stress", plot)
