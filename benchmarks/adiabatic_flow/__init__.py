# SPDX-License-Identifier: GPL-2.0-or-later
"""How warm aluminium gets by its own plastic work (Terreros 2013, table 4.1)."""
