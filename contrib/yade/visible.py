# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes a scene reachable from YADE's PyRunner commands."""

from __future__ import annotations

import builtins


def make_visible(scene: object) -> None:
    """PyRunner commands run in the main namespace; a built-in name `scene` is seen there too."""
    builtins.scene = scene  # type: ignore[attr-defined]
