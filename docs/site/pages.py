# SPDX-License-Identifier: MIT
"""The Markdown of the repository as pages of Doxygen: anchors, links and formulas as it wants them."""
import os
import re

from formulas import is_formula, set_formula, set_inline

# What stands in the tree of the site, and under which page: others are reached by links.
GUIDE = "docs/guide.md"
CHAPTERS = ["project", "one-pair", "many-pairs", "moving", "yes-no", "accuracy", "extremes", "bodies", "further", "shell",
            "ci", "simulation", "own-grains", "reference"]
BESIDE = ["docs/python.md", "docs/c.md", "docs/fortran.md", "docs/octave.md", "docs/playground.md", "docs/simulator.md", "docs/runs.md", "docs/samples.md", "docs/scenes.md", "docs/stages.md", "docs/choosing.md", "docs/lammps.md", "docs/lammps-fixes.md", "docs/scene-keys.md", "docs/grading.md", "docs/hunt.md",
          "docs/classification.md"]
MEASURED = ["docs/speed-accuracy.md", "docs/peers.md", "docs/peer-grades.md", "docs/profiles.md", "docs/trace.md",
            "docs/study.md"]
PROJECT = ["CONTRIBUTING.md", "docs/architecture.md", "docs/testing.md", "docs/trust.md", "docs/mutants.md", "docs/build-time.md",
           "docs/dependencies.md", "CHANGELOG.md", "SECURITY.md"]


# Pages whose running text has formulas.
MATHEMATICS = ("docs/derivations/", "docs/guide")


def identifier(path):
    """The name of a page, from its path."""
    name = re.sub(r"^docs/", "", path)
    return "page-" + re.sub(r"[^a-z0-9]+", "-", re.sub(r"\.md$", "", name).lower()).strip("-")


def slug(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"[`*]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)).strip().lower()
    return re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", text))


def all_pages(root):
    pages = ["README.md"] + PROJECT + [str(page.relative_to(root)) for page in sorted((root / "docs").rglob("*.md"))
                                       if "site" not in page.parts]
    return list(dict.fromkeys(page for page in pages if (root / page).exists()))


class Writer:
    """Writes the pages of a tree, each once its links are known."""

    def __init__(self, root, pages):
        self.root, self.pages = root, pages
        self.headings, self.level = {}, 0  # of the page that is being written

    def link(self, page, text, target):
        """A link of a page, as Doxygen wants it; what is not on the site is only named."""
        if re.match(r"[a-z]+:", target):
            return f"[{text}]({target})"
        path, _, anchor = target.partition("#")
        full = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if full in self.pages:
            name = identifier(full) + (f"-{anchor}" if anchor else "")
            return f"[{text}](@ref {name})"
        if full in ("docs/derivations", "docs/decisions"):
            return f"[{text}](@ref {identifier(full)})"
        if not (self.root / full).exists():
            raise SystemExit(f"{page}: the link ({target}) leads to nothing")
        return text if text.startswith("`") else f"{text} (`{full}`)"

    def mention(self, match):
        """A page that a text names, as a link."""
        return f"[{match[1]}](@ref {identifier(match[1])})" if match[1] in self.pages else match[0]

    def line(self, page, line):
        """One line of text: links, and what Doxygen would take for a command."""
        heading = re.match(r"(#+) (.*)$", line)
        if heading:
            name = slug(heading[2])
            times = self.headings[name] = self.headings.get(name, -1) + 1
            anchor = f"{identifier(page)}-{name}" + (f"-{times}" if times else "")
            # Doxygen wants no level left out.
            self.level = min(len(heading[1]), self.level + 1)
            anchor = identifier(page) if self.level == 1 else anchor
            text = heading[2].replace("`", "")  # Doxygen reads no marks in a heading
            return f"{'#' * self.level} {self.plain(page, text)} {{#{anchor}}}"
        return self.plain(page, line)

    def plain(self, page, line):
        parts = re.split(r"(!?\[[^]]*\]\([^)]*\)|`[^`]*`)", line)
        for index, part in enumerate(parts):
            link = re.fullmatch(r"(!?)\[([^]]*)\]\(([^)]*)\)", part)
            if link and link[1]:
                parts[index] = f'![{link[2]}]({os.path.basename(link[3])})'
            elif link:
                parts[index] = self.link(page, link[2], link[3])
            elif index % 2 == 0:
                part = set_inline(part) if page.startswith(MATHEMATICS) else part
                part = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", part)
                part = re.sub(r"@", r"\\@", part)
                part = re.sub(r"<(?!/?(?:b|br|sub|sup)>)", r"\\<", part)
                part = re.sub(r"(?<=\s)#(?=\w)", r"\\#", part)
                part = re.sub(r"::", r"\\::", part)
                # Doxygen takes a sum that goes on in the next line for a list, as GitHub does.
                parts[index] = re.sub(r"^\+ ", r"\\+ ", part) if index == 0 else part
                parts[index] = re.sub(r"\b(docs/[\w/.-]+\.md)\b", self.mention, parts[index])
            elif part.startswith("`"):
                parts[index] = re.sub(r"`(docs/[\w/.-]+\.md)`", self.mention, part)
        return "".join(parts)

    def page(self, page):
        lines, fenced, block = [], False, []
        self.headings, self.level = {}, 0

        def end_block():
            nonlocal block
            while block and not block[-1].strip():
                block.pop()
            if not block:
                return
            if page.startswith("docs/derivations/") and is_formula(block):
                lines.extend(["", *(f"\\f[ {set_formula(text)} \\f]\n" for text in block if text.strip()), ""])
            else:
                lines.extend(["", "```", *(text[4:] for text in block), "```", ""])
            block = []

        for line in (self.root / page).read_text(encoding="utf-8").split("\n"):
            if line.startswith("```"):
                end_block()
                fenced = not fenced
                kind = {"cpp": "{.cpp}", "python": "{.py}", "c": "{.c}"}.get(line[3:].strip().split(" ")[0], "")
                lines.append("```" + kind)
            elif fenced:
                lines.append(line)
            elif line.startswith("    ") and (block or not lines or not re.match(r"\s*([-*]|\d+\.) ", lines[-1])):
                block.append(line)
            elif block and not line.strip():
                block.append(line)
            else:
                end_block()
                if not line.startswith("<!--"):
                    lines.append(self.line(page, line))
        end_block()
        return "\n".join(lines)


def tree_page(name, title, text, pages):
    below = "".join(f"- @subpage {identifier(page)}\n" for page in pages)
    return f"# {title} {{#{name}}}\n\n{text}\n\n{below}"


def write_pages(root, folder):
    """Writes all pages into the folder; returns their paths, the first of them the main page."""
    folder.mkdir(parents=True)
    pages = all_pages(root)
    writer = Writer(root, pages)
    written = []

    def write(name, text):
        path = folder / f"{name}.md"
        path.write_text(text + "\n", encoding="utf-8")
        written.append(path)

    def there(paths):
        return [path for path in paths if path in pages]

    derivations = [page for page in pages if page.startswith("docs/derivations/")]
    decisions = [page for page in pages if page.startswith("docs/decisions/")]
    for page in pages:
        text = writer.page(page)
        if page == GUIDE:
            chapters = there([f"docs/guide/{chapter}.md" for chapter in CHAPTERS] + BESIDE)
            text += "\n## All chapters {#page-guide-all-chapters}\n\n" + "".join(
                f"- @subpage {identifier(chapter)}\n" for chapter in chapters)
        write(identifier(page), text)
    write("page-derivations", tree_page("page-derivations", "Derivations", "Why the answers hold.", derivations))
    write("page-decisions", tree_page("page-decisions", "Decisions", "What was decided, and what was rejected.", decisions))
    write("page-measured", tree_page("page-measured", "Measured", "What was measured, and how.", there(MEASURED)))
    write("page-project", tree_page("page-project", "The project", "How it is built and tested.",
                                    [page for page in there(PROJECT)]))
    return written
