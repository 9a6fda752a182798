# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter sweeps of one scene: run side by side, resumable, measured, drawn."""
