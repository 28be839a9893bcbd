#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What Doxygen 1.9 reads of a header: the header itself, line by line, but for three things.

`namespace tangency::inline v0` becomes `namespace tangency`, since it does not know the longer form. Of
`double a, b;  ///< text` it gives the text to b alone, so each name gets a declaration with the text.
In comments < and > are signs of less, greater and mean, and :: between single letters a contraction.
Usage: header_filter.py HEADER
"""
import re
import sys

NAMESPACE = re.compile(r"^namespace tangency::inline v0\b")
DECLARATION = re.compile(
    r"^(\s*)((?:const |inline |constexpr )*[\w:]+(?:<[^;={}]*>)?[ *&]+)([^;()]*(?:\([^;()]*\))?[^;]*);\s*(///<.*)?$")


def declarators(text):
    """The parts of `a = f(1, 2), b{}` between commas that no bracket holds."""
    depth, part = 0, ""
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            yield part.strip()
            part = ""
        else:
            part += character
    yield part.strip()


def plain(comment):
    """A line of a comment, with what Doxygen takes for HTML or a link escaped; not of an indented formula."""
    if re.match(r"^\s*///(<?)\s{4,}\S", comment):
        return comment
    parts = re.split(r"(`[^`]*`|^\s*///<?)", comment)
    for index in range(0, len(parts), 2):
        parts[index] = re.sub(r"([<>])", r"\\\1", parts[index])
        parts[index] = re.sub(r"(?<![A-Za-z]{2})::(?=[nu]{4}\b|axis)", r"\\::", parts[index])
    return "".join(parts)


def split(line, above):
    """One declaration a name, each with the text behind the line or, without one, with that above it."""
    match = DECLARATION.match(line)
    if not match:
        return line
    indent, kind, names, behind = match.groups()
    parts = list(declarators(names))
    named = all(re.match(r"\*?\w+\s*(=|\{|$)", part) for part in parts)
    said = plain((behind or "").removeprefix("///<").strip()) or above
    if len(parts) < 2 or not named or not said or kind.split()[0] in ("return", "using"):
        return line
    star = "*" if kind.endswith("*") else ""
    kind = kind.rstrip("*")
    parts[0] = star + parts[0]
    if not behind:  # the first has the text above
        return indent + f"{kind}{parts[0]}; " + " ".join(f"/** {said} */ {kind}{part};" for part in parts[1:])
    return indent + " ".join(f"{kind}{part}; /**< {said} */" for part in parts)


def main():
    with open(sys.argv[1], encoding="utf-8") as header:
        lines = header.read().split("\n")
    above = ""
    for number, line in enumerate(lines):
        comment = re.match(r"^\s*///(?!<)(.*)$", line)
        if comment:
            lines[number] = plain(line)
            above = (above + " " + plain(comment[1].strip())).strip()
            continue
        # A text that goes on in the next line stays as it is: it is that of one name.
        goes_on = number + 1 < len(lines) and re.match(r"^\s*///<", lines[number + 1])
        lines[number] = NAMESPACE.sub("namespace tangency", line if goes_on else split(line, above))
        above = ""
    print("\n".join(lines), end="")


main()
