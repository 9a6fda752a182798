# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the same cases in several codes and says where they agree."""
