# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether advice keeps its word."""
