# SPDX-License-Identifier: GPL-2.0-or-later
"""What a bond costs in one step, in every code."""
