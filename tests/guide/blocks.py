# SPDX-License-Identifier: GPL-3.0-or-later
"""The code blocks of the pages that users read, and what stands in them."""
import re
from dataclasses import dataclass

FENCE = re.compile(r"^```(?:python (?=matplotlib))?(\w*)\s*$")
# What is checked, and by whom: cpp and console by the gate, sh and cmake by the longer check `guide`; text is
# the output of the cpp block before it; the others have tests beside the language's own. What draws with
# Matplotlib, "python matplotlib", is run by the longer check `bindings`.
KINDS = {"cpp", "text", "console", "sh", "cmake", "yaml", "c", "python", "matplotlib", "fortran", "octave"}


@dataclass
class Block:
    page: str   # path from the root
    line: int   # of its first line of code
    kind: str
    text: str

    def place(self):
        return f"{self.page}:{self.line}"


def blocks_of(root, page):
    """The fenced blocks of a page, in order. A block without a known kind is refused: nothing would check it."""
    found, kind, lines, start = [], None, [], 0
    for number, line in enumerate((root / page).read_text(encoding="utf-8").split("\n"), 1):
        fence = FENCE.match(line)
        if kind is None and fence:
            kind, lines, start = fence[1], [], number + 1
            if kind not in KINDS:
                raise SystemExit(f"{page}:{number}: a block of kind '{kind}': allowed are {', '.join(sorted(KINDS))}")
        elif kind is not None and line.startswith("```"):
            found.append(Block(page, start, kind, "".join(text + "\n" for text in lines)))
            kind = None
        elif kind is not None:
            lines.append(line)
        elif re.match(r"^ {4}\S", line):
            raise SystemExit(f"{page}:{number}: a block by indentation: nothing checks it; write ``` and its kind")
    if kind is not None:
        raise SystemExit(f"{page}:{start - 1}: a block without an end")
    return found


def user_pages(root):
    """The pages whose blocks are run: README, the guide and its chapters."""
    return ["README.md", "docs/guide.md"] + sorted(
        str(page.relative_to(root)) for page in (root / "docs" / "guide").glob("*.md"))
