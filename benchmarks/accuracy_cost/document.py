# SPDX-License-Identifier: GPL-2.0-or-later
"""A page of headings, paragraphs, lists, tables and pictures, as Markdown and as HTML."""

from __future__ import annotations

import base64
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 66em; padding: 0 1em;
       color: #1c2733; }
h1, h2, h3 { font-weight: 600; }
table { border-collapse: collapse; font-size: 14px; }
th, td { padding: .3em .8em .3em 0; text-align: left; border-bottom: 1px solid #dde3ea; }
th { color: #5b6b7c; font-weight: 500; }
img { max-width: 100%; }
"""


@dataclass
class Document:
    """The blocks of a page, in order."""

    title: str
    markdown: list[str] = field(default_factory=list)
    html: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.heading(1, self.title)

    def heading(self, level: int, text: str) -> None:
        """A heading."""
        self.markdown.append("#" * level + f" {text}")
        self.html.append(f"<h{level}>{escape(text)}</h{level}>")

    def paragraph(self, text: str) -> None:
        """A paragraph of plain words."""
        self.markdown.append(text)
        self.html.append(f"<p>{escape(text)}</p>")

    def items(self, texts: list[str]) -> None:
        """A list."""
        self.markdown.append("\n".join(f"- {text}" for text in texts))
        self.html.append("<ul>" + "".join(f"<li>{escape(t)}</li>" for t in texts) + "</ul>")

    def table(self, header: list[str], rows: list[list[str]]) -> None:
        """A table."""
        lines = [header, ["---"] * len(header), *rows]
        self.markdown.append("\n".join("| " + " | ".join(line) + " |" for line in lines))
        head = "".join(f"<th>{escape(word)}</th>" for word in header)
        body = "".join("<tr>" + "".join(f"<td>{escape(word)}</td>" for word in row) + "</tr>"
                       for row in rows)
        self.html.append(f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>")

    def picture(self, path: Path, text: str) -> None:
        """A picture beside the page; the HTML holds a copy."""
        self.markdown.append(f"![{text}]({path.name})")
        data = base64.b64encode(path.read_bytes()).decode()
        self.html.append(f'<img alt="{escape(text)}" src="data:image/png;base64,{data}">')

    def write(self, folder: Path) -> None:
        """Writes page.md and index.html."""
        (folder / "page.md").write_text("\n\n".join(self.markdown) + "\n")
        (folder / "index.html").write_text(
            f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>'
            f"{escape(self.title)}</title><style>{STYLE}</style></head><body>"
            + "\n".join(self.html) + "</body></html>\n")
