#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the C++ blocks of README and guide as functions, with what each has to print.

A block is the body of a function, or a program with its includes and `int main() {`. What it prints is the block
of kind text that follows it, and nothing where none does.
Usage: cpp_examples.py ROOT OUTPUT
"""
import pathlib
import re
import sys

from blocks import blocks_of, user_pages


def main():
    root, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    includes, functions, rows = set(), [], []
    for page in user_pages(root):
        blocks = blocks_of(root, page)
        for number, block in enumerate(blocks):
            if block.kind != "cpp":
                continue
            code = block.text
            includes.update(re.findall(r"(?m)^#include .*$", code))
            code = re.sub(r"(?m)^#include .*$", "", code)
            program = re.fullmatch(r"(?s)(.*?)\nint main\(\) \{\n(.*)\n\}\n", code)
            before, body = program.groups() if program else ("", code)
            name = f"example_{len(rows)}"
            line = block.line + block.text[:block.text.find("int main() {")].count("\n") + 1 if program else block.line
            functions.append(f"{before}\nvoid {name}() {{\n#line {line} \"{page}\"\n{body}\n}}\n")
            follows = blocks[number + 1] if number + 1 < len(blocks) else None
            printed = follows.text if follows and follows.kind == "text" else ""
            rows.append(f'  {{"{block.place()}", {name}, R"~({printed})~"}},\n')
    text = "".join(sorted(include + "\n" for include in includes)) + "\nnamespace {\n" + "".join(functions)
    text += "const Example kExamples[] = {\n" + "".join(rows) + "};\n}  // namespace\n"
    output.write_text(text, encoding="utf-8")


main()
