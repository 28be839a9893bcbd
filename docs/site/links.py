#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Links of a site of plain files: every href and src leads to a file of the site, and every #anchor to a place in it.

Usage: links.py FOLDER
"""
import pathlib
import sys
import urllib.parse
from html.parser import HTMLParser


class Page(HTMLParser):
    """Links and anchors of one page."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src", "data", "xlink:href") and value:
                self.links.append((self.getpos()[0], value))
            elif name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)


def dead_links(folder):
    """(one line a dead link, how many links of the site there are)."""
    pages = {path: Page(path.read_text(encoding="utf-8", errors="replace"))
             for path in sorted(folder.rglob("*.html")) if "mathjax" not in path.relative_to(folder).parts}
    dead, count = [], 0
    for path, page in pages.items():
        for line, link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme in ("http", "https", "mailto", "javascript", "data"):
                continue
            count += 1
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            anchor = urllib.parse.unquote(parts.fragment)
            place = f"{path.relative_to(folder)}:{line}: {link}"
            if folder.resolve() not in [target, *target.parents]:
                dead.append(f"{place}: leads out of the site")
            elif not target.is_file():
                dead.append(f"{place}: no such file")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                dead.append(f"{place}: no such anchor")
    return dead, count


if __name__ == "__main__":
    dead, count = dead_links(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(dead), file=sys.stderr)
    print(f"{count} links, {len(dead)} dead")
    sys.exit(1 if dead else 0)
