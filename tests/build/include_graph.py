#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The include graph of the tree: its circles, its arrows against the floors, its closures.

A node is a unit: a header and the source of the same name. An arrow runs from a unit to what it
includes. A floor is a line of tests/build/floors, and the rooms on it stand between bars; a unit may
include its own room and the floors below.

Usage: include_graph.py ROOT [--floors FILE] [--closure UNIT ...] [--dot]
Prints circles, arrows against the floors, and the libraries' files that name Eigen:: and do not
include it, and ends with 1 where there are any.
--closure names a unit, as geometry/relation, and prints the files that its source reads, and their lines.
--dot prints the graph of rooms for Graphviz, floor by floor: docs/architecture.dot.
"""

import argparse
import os
import sys

FOLDERS = ("geometry", "dem", "verify", "bench", "tests")
ENDINGS = (".hpp", ".cpp", ".h", ".c")
PREFIX = "tangency/"  # of <tangency/FOLDER/NAME.hpp>: docs/decisions/0002-include-paths.md
MADE = {"tangency/version.hpp"}  # by CMake, and includes nothing


def directives(text):
    """The preprocessor's lines, without comments; strings, raw ones included, hide theirs."""
    lines, line, at, size = [], [], 0, len(text)
    while at < size:
        two = text[at:at + 2]
        if two == "\\\n":
            at += 2
        elif two == "//":
            while at < size and text[at] != "\n":
                at += 2 if text[at:at + 2] == "\\\n" else 1
        elif two == "/*":
            end = text.find("*/", at + 2)
            at = size if end < 0 else end + 2
            line.append(" ")
        elif two == 'R"' and not (at and (text[at - 1].isalnum() or text[at - 1] == "_")):
            opened = text.index("(", at)
            closing = ")" + text[at + 2:opened] + '"'
            at = text.index(closing, opened) + len(closing)
            line.append('""')
        elif text[at] in "\"'" and not (text[at] == "'" and at and text[at - 1].isalnum()):
            quote, end = text[at], at + 1
            while end < size and text[end] not in (quote, "\n"):
                end += 2 if text[end] == "\\" else 1
            line.append(text[at:end + 1].rstrip("\n"))
            at = end + 1 if text[end:end + 1] == quote else end
        elif text[at] == "\n":
            lines.append("".join(line))
            line, at = [], at + 1
        else:
            line.append(text[at])
            at += 1
    lines.append("".join(line))
    return [each.strip()[1:].strip() for each in lines if each.strip().startswith("#")]


def included(path, text, files):
    """The files of the tree that a file includes by name."""
    found = set()
    for directive in directives(text):
        if not directive.startswith("include"):
            continue
        name = directive[len("include"):].strip().strip('<>"')
        beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
        for candidate in (name[len(PREFIX):] if name.startswith(PREFIX) else None, beside):
            if candidate in files:
                found.add(candidate)
                break
        else:
            if name.startswith(PREFIX) and name not in MADE:
                sys.exit(f"{path}: <{name}> is not in the tree")
    return found


def unit(path):
    return os.path.splitext(path)[0]


class Tree:
    def __init__(self, root):
        self.text = {}
        for folder in FOLDERS:
            for place, _, names in os.walk(os.path.join(root, folder)):
                for name in names:
                    if name.endswith(ENDINGS):
                        path = os.path.join(place, name)
                        with open(path, encoding="utf-8") as file:
                            self.text[os.path.relpath(path, root)] = file.read()
        self.arrows = {path: included(path, text, self.text) for path, text in self.text.items()}
        self.units = {}
        for path, targets in self.arrows.items():
            self.units.setdefault(unit(path), set()).update(
                unit(target) for target in targets if unit(target) != unit(path))

    def circles(self):
        """Sets of units that reach each other [Tarjan's algorithm, without recursion]."""
        index, low, stack, on_stack, found = {}, {}, [], set(), []
        for start in sorted(self.units):
            if start in index:
                continue
            index[start] = low[start] = len(index)
            stack.append(start)
            on_stack.add(start)
            way = [(start, iter(sorted(self.units[start])))]
            while way:
                here, targets = way[-1]
                target = next(targets, None)
                if target is None:
                    way.pop()
                    if way:
                        low[way[-1][0]] = min(low[way[-1][0]], low[here])
                    if low[here] == index[here]:
                        circle = set()
                        while here not in circle:
                            circle.add(stack.pop())
                        on_stack -= circle
                        if len(circle) > 1:
                            found.append(sorted(circle))
                elif target not in index:
                    index[target] = low[target] = len(index)
                    stack.append(target)
                    on_stack.add(target)
                    way.append((target, iter(sorted(self.units[target]))))
                elif target in on_stack:
                    low[here] = min(low[here], index[target])
        return found

    def closure(self, start):
        """The source of a unit, and every file of the tree that it reads, headers alone."""
        return self.reached(
            next(path for path in (start + ".cpp", start + ".hpp") if path in self.text))

    def reached(self, first):
        """A file, and every file of the tree that it includes, at any depth."""
        seen, waiting = set(), [first]
        while waiting:
            path = waiting.pop()
            if path not in seen:
                seen.add(path)
                waiting.extend(self.arrows[path])
        return seen

    def reading(self, start):
        """What a reader of a unit has to know: its files and, from there on, those of each unit."""
        seen, waiting = set(), [start]
        while waiting:
            here = waiting.pop()
            if here not in seen:
                seen.add(here)
                waiting.extend(self.units[here])
        return {path for path in self.text if unit(path) in seen}


class Floors:
    """A line of the file is a floor, the lowest first: its rooms, each a folder and what belongs to it."""

    def __init__(self, path):
        self.of = {}  # of a room: its floor
        self.rooms = {}  # of a folder or a unit: its room, the folder that is named first
        with open(path, encoding="utf-8") as file:
            lines = [line.split("#")[0].strip() for line in file]
        for floor, line in enumerate(line for line in lines if line):
            for names in (room.split() for room in line.split("|")):
                self.of[names[0]] = floor
                self.rooms.update((name, names[0]) for name in names)

    def room(self, path):
        name = path
        while name and name not in self.rooms:
            name = os.path.dirname(name)
        if not name:
            sys.exit(f"{path} lies in no room: name its folder in tests/build/floors")
        return self.rooms[name]

    def against(self, tree):
        for path, targets in sorted(tree.arrows.items()):
            here = self.room(unit(path))
            for target in sorted(targets):
                there = self.room(unit(target))
                if self.of[there] > self.of[here]:
                    yield f"{path} includes {target}, which lies above it"
                elif here != there and self.of[there] == self.of[here]:
                    yield f"{path} includes {target}: {here} and {there} share a floor"


# The libraries' precompiled header holds what this header includes: CMakeLists.txt.
EIGEN = "geometry/vectors.hpp"


def without_eigen(tree):
    """The libraries' files that name Eigen:: and do not reach its headers by their own includes."""
    for path, text in sorted(tree.text.items()):
        if path.startswith(("geometry/", "dem/")) and "Eigen::" in text:
            if EIGEN not in tree.reached(path):
                yield f"{path} names Eigen:: and does not reach {EIGEN} by its includes"


def dot(tree, floors):
    """The rooms but for the tests, the highest floor on top, and their arrows but for those that others imply."""
    arrows = {}
    for path, targets in tree.arrows.items():
        here = floors.room(unit(path))
        if not here.startswith("tests"):
            arrows.setdefault(here, set()).update(
                there for there in map(floors.room, map(unit, targets)) if there != here)

    def reached(start):
        found, waiting = set(), [start]
        while waiting:
            waiting.extend(new := arrows[waiting.pop()] - found)
            found |= new
        return found

    lines = ["digraph rooms {", "  node [shape=box, fontname=\"sans-serif\"];"]
    for floor in sorted(set(floors.of.values()), reverse=True):
        same = [f'"{name}"' for name in sorted(arrows) if floors.of[name] == floor]
        if same:
            lines.append(f"  {{ rank=same; {'; '.join(same)} }}")
    for here in sorted(arrows):
        implied = set().union(*map(reached, arrows[here]))
        lines += [f'  "{here}" -> "{there}";' for there in sorted(arrows[here] - implied)]
    return "\n".join(lines + ["}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("root")
    parser.add_argument("--floors")
    parser.add_argument("--closure", nargs="+", default=[])
    parser.add_argument("--dot", action="store_true")
    arguments = parser.parse_args()
    tree = Tree(arguments.root)
    floors = Floors(arguments.floors or os.path.join(arguments.root, "tests/build/floors"))
    if arguments.dot:
        print("// SPDX-License-Identifier: MIT\n// Made by tests/build/include_graph.py . --dot")
        print(dot(tree, floors))
        return 0
    for start in arguments.closure:
        if start not in tree.units:
            sys.exit(f"{start}: no such unit, as geometry/relation")
        for what, paths in (("headers", tree.closure(start)), ("units", tree.reading(start))):
            lines = sum(tree.text[path].count("\n") for path in paths)
            print(f"{start} by {what}: {len(paths)} files, {lines} lines")
    if arguments.closure:
        return 0
    circles = tree.circles()
    for circle in circles:
        print("a circle of includes: " + ", ".join(circle))
    against = list(floors.against(tree))
    hidden = list(without_eigen(tree))
    for line in against + hidden:
        print(line)
    print(f"{len(tree.units)} units, {sum(map(len, tree.units.values()))} arrows, "
          f"{len(circles)} circles, {len(against)} arrows against the floors, "
          f"{len(hidden)} files that name Eigen unincluded")
    return 1 if circles or against or hidden else 0


if __name__ == "__main__":
    sys.exit(main())
