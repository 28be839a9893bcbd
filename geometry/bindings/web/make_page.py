#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The playground as one file: the page, its style and programs, the kernel's module and the licences of its parts.

Usage: make_page.py MODULE GMP VERSION OUTPUT
MODULE is tangency.wasm, GMP the folder of GMP's source with Debian's changelog, VERSION that of Tangency. The same
input makes the same bytes.
"""
import base64
import gzip
import html
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
# Whose code the module holds beside ours and GMP's: Debian keeps their licences here.
PARTS = ("libc++-16-dev-wasm32", "libclang-rt-16-dev-wasm32", "wasi-libc", "libeigen3-dev")


def included(match):
    text = (HERE / match[1]).read_text(encoding="utf-8")
    if "</script" in text or "</style" in text:
        raise SystemExit(f"{match[1]}: holds the end of the element that it is put in")
    return text


def licences(gmp):
    texts = [("Tangency", ROOT / "LICENSE"), ("GMP", gmp / "COPYING.LESSERv3"),
             ("GMP, to which that refers", gmp / "COPYINGv3")]
    texts += [(name, pathlib.Path("/usr/share/doc") / name / "copyright") for name in PARTS]
    for name, path in texts:
        if not path.exists():
            raise SystemExit(f"{path} is missing: the page has to hold the licence of {name}")
    return "\n\n".join(f"==== {name}\n\n{path.read_text(encoding='utf-8').strip()}" for name, path in texts)


def main():
    if len(sys.argv) != 5:
        raise SystemExit("usage: make_page.py MODULE GMP VERSION OUTPUT")
    module, gmp, version, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
    changes = (gmp / "debian" / "changelog").read_text(encoding="utf-8")
    packed = gzip.compress(module.read_bytes(), 9, mtime=0)
    values = {"version": version, "gmp-version": re.match(r"gmp \(([^)]+)\)", changes)[1],
              "licences": html.escape(licences(gmp), quote=False), "module": base64.b64encode(packed).decode("ascii")}
    page = (HERE / "page.html").read_text(encoding="utf-8")
    page = re.sub(r"(?m)^@include (\S+)\n", included, page)
    page = re.sub(r"@(version|gmp-version|licences|module)\b", lambda match: values[match[1]], page)
    part = output.with_name(output.name + ".part")
    part.write_text(page, encoding="utf-8")
    part.replace(output)
    print(f"{output}: {len(page.encode('utf-8')) / 1e3:.0f} kB, of which the module {len(values['module']) / 1e3:.0f} kB "
          f"({module.stat().st_size / 1e3:.0f} kB unpacked)")


main()
