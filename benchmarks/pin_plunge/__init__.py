# SPDX-License-Identifier: GPL-2.0-or-later
"""The pin of a friction-stir tool goes into a plate of aluminium (Terreros 2013, figure 4.12)."""
