# SPDX-License-Identifier: GPL-2.0-or-later
"""How a strip of two metals curls, over the number of its elements."""
