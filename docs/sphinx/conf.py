# SPDX-License-Identifier: GPL-2.0-or-later
"""How Sphinx builds the pages; docs/make_html calls it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from docutils.nodes import Element, SkipNode

ROOT = Path(__file__).resolve().parents[2]

project = "solidem"
author = copyright = "the solidem developers"
release = re.findall(r"project\(solidem VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[0]

extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
root_doc = "README"
highlight_language = "none"
language = "en"

html_theme = "furo"
html_title = f"solidem {release}"
html_static_path = ["static", "/usr/share/javascript/katex"]
html_css_files = ["katex.min.css", "pages.css"]
html_js_files = ["katex.min.js", "formulas.js"]
html_copy_source = False
html_math_renderer = "katex"


def formula(translator: Any, node: Element) -> None:
    """TeX that static/formulas.js turns into a formula."""
    tag = "div" if node.tagname == "math_block" else "span"
    translator.body.append(translator.starttag(node, tag, "", CLASS="formula " + node.tagname)
                           + translator.encode(node.astext()) + f"</{tag}>")
    raise SkipNode


def setup(app: Any) -> None:
    app.add_html_math_renderer("katex", (formula, None), (formula, None))
