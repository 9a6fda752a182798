# SPDX-License-Identifier: GPL-2.0-or-later
"""The order of tests: files are handed out in it to the processes that run them (tests/run)."""

from __future__ import annotations

import os
from collections import Counter

import pytest

# Commands in Python call Debian's, as these tests do, whatever environment they are called from.
os.environ.pop("VIRTUAL_ENV", None)


@pytest.hookimpl(trylast=True)  # once those that are not asked for are gone
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Files with the most slow tests first: begun last, one would keep a single processor busy alone."""
    slow = Counter(item.path for item in items if item.get_closest_marker("slow"))
    items.sort(key=lambda item: -slow[item.path])
