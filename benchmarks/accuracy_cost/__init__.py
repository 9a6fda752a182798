# SPDX-License-Identifier: GPL-2.0-or-later
"""What accuracy costs in time: error against wall time, each point from real runs."""
