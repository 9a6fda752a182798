# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixtures of these tests."""

from fake_codes import case_directory  # noqa: F401
