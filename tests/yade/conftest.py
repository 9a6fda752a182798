# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixtures of these tests."""

from prepared_bar import bar  # noqa: F401
