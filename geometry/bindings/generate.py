#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes what table.py describes in every language.

Usage: generate.py [FOLDER]
Writes the files below into FOLDER, by default the one of this program, and prints the names of those
that changed. tests/bindings/generated.sh holds that the committed ones are these.
"""

import re
import sys
import textwrap
from pathlib import Path

import table

MARK = "Made by geometry/bindings/generate.py of table.py. Change those."
LICENCE = "SPDX-License-Identifier: MIT"
C_OF = {"unsigned": "unsigned int"}
FORTRAN_OF = {"double": "real(c_double)", "int": "integer(c_int)", "unsigned": "integer(c_int)",
              "unsigned char": "integer(c_signed_char)", "size_t": "integer(c_size_t)",
              "ptrdiff_t": "integer(c_ptrdiff_t)"}
CTYPES_OF = {"double": "c_double", "int": "c_int", "size_t": "c_size_t", "ptrdiff_t": "c_ssize_t"}
NUMPY_OF = {"double": "float64", "int": "int32", "unsigned": "uint32", "unsigned char": "uint8"}


class Type:
    """A type of the table, taken apart."""

    def __init__(self, text):
        self.optional = text.endswith("?")
        text = text.rstrip("?")
        found = re.fullmatch(r"(double|int|unsigned|unsigned char)(\*?)(?:\[([\d,]*)\])?", text)
        self.base, self.text = None, text
        self.is_array = self.is_written = False
        self.shape = ()
        if found:
            self.base = found[1]
            self.is_written = bool(found[2])
            self.is_array = found[3] is not None
            self.shape = tuple(int(n) for n in (found[3] or "").split(",") if n)

    def c(self):
        if self.base is None:
            return self.text
        name = C_OF.get(self.base, self.base)
        if self.is_written:
            return name + "*"
        return f"const {name}*" if self.is_array else name


def wrapped(text, prefix, width=98):
    return textwrap.wrap(text, width, initial_indent=prefix, subsequent_indent=prefix,
                         break_on_hyphens=False, break_long_words=False) if text else []


def described(item):
    """What a comment says of a field or an argument."""
    shape = Type(item.type).shape
    parts = ["x".join(map(str, shape)) + " a row"] if shape else []
    if item.unit and item.unit != "1":
        parts.append("unit: " + item.unit)
    text = item.doc + (f" ({', '.join(parts)})" if parts else "")
    return text.strip()


def constant(enum, member):
    return f"TANGENCY_{enum.name}_{member}".upper() if enum.name != "code" else f"TANGENCY_{member}".upper()


# ---- C

def c_header():
    out = [f"/* {LICENCE} */", f"/* {MARK} */", '/** @file']
    out += wrapped("How ellipsoids touch, exactly: the interface in C (C89).", " * ")
    out.append(" *")
    out += wrapped(
        "A right-handed frame; lengths in any one unit; a gap > 0 is a distance, a gap < 0 minus a penetration "
        "depth; normals point from A to B. Rows and indices count from 0. Every struct begins with its size, "
        "which the caller sets to sizeof; what is NULL in it is not asked for. A call returns TANGENCY_OK, or "
        "says why not in tangency_error_message(); then columns of answers mean nothing. No call ends the process for numbers it is "
        "handed; where memory ends within an exact answer, the process ends. Any number of threads may ask "
        "about the same bodies while none changes them.", " * ")
    out += [" */", "#ifndef TANGENCY_H", "#define TANGENCY_H", "", "#include <stddef.h>", "",
            "#ifndef TANGENCY_API", "#if defined(__GNUC__)",
            '#define TANGENCY_API __attribute__((visibility("default")))', "#else", "#define TANGENCY_API",
            "#endif", "#endif", "", "#ifdef __cplusplus", 'extern "C" {', "#endif", ""]
    for name, doc in table.OPAQUE:
        out += [f"/** {doc} */", f"typedef struct tangency_{name} tangency_{name};", ""]
    for enum in table.ENUMS:
        out += comment(enum.doc, "")
        out.append(f"enum tangency_{enum.name} {{")
        last = len(enum.members) - 1
        for value, (member, doc) in enumerate(enum.members):
            out += comment(doc, "  ")
            out.append(f"  {constant(enum, member)} = {value}{'' if value == last else ','}")
        out += ["};", ""]
    for struct in table.STRUCTS:
        out += comment(struct.doc, "")
        out += [f"typedef struct tangency_{struct.name} {{", "  /** sizeof(this struct) */", "  size_t size;"]
        for item in struct.fields:
            out += comment(described(item), "  ")
            out.append(f"  {Type(item.type).c()} {item.name};")
        out += [f"}} tangency_{struct.name};", ""]
    for function in table.FUNCTIONS:
        text = function.doc
        for item in function.arguments:
            if described(item):
                text += f"\n@param {item.name}  {described(item)}"
        out += comment(text, "")
        head = f"TANGENCY_API {function.returns} tangency_{function.name}("
        arguments = [f"{Type(a.type).c()} {a.name}" for a in function.arguments] or ["void"]
        out += textwrap.wrap(head + ", ".join(arguments) + ");", 98, subsequent_indent="    ",
                             break_long_words=False)
        out.append("")
    out += ["#ifdef __cplusplus", "}", "#endif", "", "#endif"]
    return "\n".join(out) + "\n"


def comment(text, indent):
    if not text:
        return []
    if "\n" not in text and len(text) + len(indent) < 90:
        return [f"{indent}/** {text} */"]
    lines = []
    for part in text.split("\n"):
        lines += wrapped(part, indent + " * ")
    return [indent + "/**"] + lines + [indent + " */"]


def same_values():
    out = [f"// {LICENCE}", f"// {MARK}", "/// @file",
           "/// The numbers of tangency.h are those of the C++ library, and the names of all.", "#pragma once", "",
           "#include <array>", "#include <string_view>", "",
           "#include <tangency/geometry/bindings/c/tangency.h>",
           "#include <tangency/geometry/classify.hpp>",
           "#include <tangency/geometry/common_volume.hpp>",
           "#include <tangency/geometry/ellipse_crossings.hpp>",
           "#include <tangency/geometry/gap_derivatives.hpp>",
           "#include <tangency/geometry/neighbour_columns.hpp>",
           "#include <tangency/geometry/other_gaps.hpp>",
           "#include <tangency/geometry/ray.hpp>",
           "#include <tangency/geometry/relation.hpp>",
           "#include <tangency/geometry/time_of_contact.hpp>",
           "", "namespace tangency::inline v0::c {", ""]
    for enum in table.ENUMS:
        for member, _ in enum.members if enum.cpp else ():
            line = f"static_assert(static_cast<int>({enum.cpp}::{member}) == {constant(enum, member)});"
            out += [line] if len(line) <= 100 else line.replace("== ", "==\n" + " " * 14).split("\n")
    out += ["", "struct EnumerationName {", "  std::string_view enumeration;", "  int value;",
            "  const char* name;", "};", ""]
    rows = [f'    {{"{e.name}", {v}, "{m}"}},' for e in table.ENUMS for v, (m, _) in enumerate(e.members)]
    out += [f"inline constexpr std::array<EnumerationName, {len(rows)}> kNames{{{{"] + rows + ["}};", "",
            "}  // namespace tangency::inline v0::c"]
    return "\n".join(out) + "\n"


# ---- Fortran

def fortran_lines(text, indent):
    """One statement, continued where a line would be too long."""
    lines = textwrap.wrap(text, 96, initial_indent=indent, subsequent_indent=indent + "    ",
                          break_long_words=False, break_on_hyphens=False)
    return [line + " &" for line in lines[:-1]] + lines[-1:]


def fortran_argument(item):
    kind = Type(item.type)
    optional = ", optional" if kind.optional else ""
    if kind.base and kind.is_array:
        intent = "inout" if kind.is_written else "in"
        shape = ",".join([*map(str, reversed(kind.shape)), "*"])
        return f"{FORTRAN_OF[kind.base]}, intent({intent}){optional} :: {item.name}({shape})"
    if kind.base:
        return (f"{FORTRAN_OF[kind.base]}, " + ("intent(out)" if kind.is_written else "value")
                + f" :: {item.name}")
    if kind.text == "const double*":
        return f"real(c_double), intent(in) :: {item.name}(*)"
    if kind.text == "const char*":
        return f"character(kind=c_char), intent(in) :: {item.name}(*)"
    if kind.text.endswith("**"):
        return f"type(c_ptr), intent(out) :: {item.name}"
    struct = kind.text.replace("const ", "").rstrip("*").replace("tangency_", "")
    if struct in {s.name for s in table.STRUCTS}:
        intent = "in" if kind.text.startswith("const") else "inout"
        return f"type(tangency_{struct}), intent({intent}){optional} :: {item.name}"
    if kind.text in FORTRAN_OF:
        return f"{FORTRAN_OF[kind.text]}, value :: {item.name}"
    return f"type(c_ptr), value :: {item.name}"


def size_of(struct):
    """Bytes where pointers and size_t have eight."""
    sizes = [{"double": 8, "int": 4}.get(i.type, 8) for i in struct.fields]
    at = 8
    for size in sizes:
        at = (at + size - 1) // size * size + size
    return at


def fortran_module():
    out = [f"! {LICENCE}", f"! {MARK}",
           "! tangency.h in Fortran 2018, for machines of 64 bits. Rows are columns here, and places of bodies,",
           "! walls and the like count from 0. An argument that is optional may be left out. Columns of answers",
           "! are set by c_loc(); what is c_null_ptr is not asked for.",
           "module tangency", "  use, intrinsic :: iso_c_binding", "  implicit none", "  public", ""]
    for enum in table.ENUMS:
        out += wrapped(enum.doc, "  ! ", 96)
        for value, (member, doc) in enumerate(enum.members):
            out += wrapped(doc, "  ! ", 96)
            out.append(f"  integer(c_int), parameter :: {constant(enum, member)} = {value}")
        out.append("")
    for struct in table.STRUCTS:
        out += wrapped(struct.doc, "  ! ", 96)
        out += [f"  type, bind(c) :: tangency_{struct.name}",
                f"    integer(c_size_t) :: size = {size_of(struct)}_c_size_t"]
        for item in struct.fields:
            out += wrapped(described(item), "    ! ", 96)
            kind = Type(item.type)
            scalar = {"double": "real(c_double)", "int": "integer(c_int)"}.get(item.type)
            zero = {"double": "0.0_c_double", "int": "0_c_int"}.get(item.type)
            if scalar:
                out.append(f"    {scalar} :: {item.name} = {zero}")
            else:
                out.append(f"    type(c_ptr) :: {item.name} = c_null_ptr")
        out += [f"  end type tangency_{struct.name}", ""]
    out.append("  interface")
    for function in table.FUNCTIONS:
        out += [""] + wrapped(function.doc, "    ! ", 96)
        for item in function.arguments:
            if described(item):
                out += wrapped(f"{item.name}: {described(item)}", "    !   ", 96)
        names = ", ".join(a.name for a in function.arguments)
        kind = "subroutine" if function.returns == "void" else "function"
        result = {"int": "integer(c_int)", "size_t": "integer(c_size_t)", "const char*": "type(c_ptr)"}
        prefix = "" if kind == "subroutine" else "function "
        head = f"{kind if not prefix else 'function'} tangency_{function.name}({names})"
        tail = f' bind(c, name="tangency_{function.name}")' + ("" if not prefix else " result(code)")
        out += fortran_lines(head + tail, "    ")
        used = sorted({s.name for s in table.STRUCTS
                       for a in function.arguments if re.search(rf"tangency_{s.name}\*", a.type)})
        out.append("      use, intrinsic :: iso_c_binding")
        out += fortran_lines("import :: " + ", ".join(f"tangency_{u}" for u in used), "      ") if used else []
        out += [f"      {fortran_argument(a)}" for a in function.arguments]
        if prefix:
            out.append(f"      {result[function.returns]} :: code")
        out.append(f"    end {kind} tangency_{function.name}")
    out += ["", "  end interface", "", "contains", "",
            "  ! The text at a pointer to C's characters, as of tangency_error_message().",
            "  function tangency_text(from) result(text)",
            "    type(c_ptr), intent(in) :: from",
            "    character(len=:), allocatable :: text",
            "    character(kind=c_char), pointer :: letters(:)",
            "    integer :: length",
            '    text = ""',
            "    if (.not. c_associated(from)) return",
            "    call c_f_pointer(from, letters, [4096])",
            "    do length = 1, 4096",
            "      if (letters(length) == c_null_char) exit",
            "      text = text // letters(length)",
            "    end do",
            "  end function tangency_text", "", "end module tangency"]
    return "\n".join(out) + "\n"


# ---- Python

def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


def ctypes_of(kind):
    if kind.is_array or kind.is_written or kind.text.endswith("*"):
        return "c_char_p" if kind.text == "const char*" else "c_void_p"
    return CTYPES_OF[kind.base or kind.text]


def python_prototypes():
    out = [f"# {LICENCE}", f"# {MARK}", '"""Prototypes of the C library for ctypes, its constants and the classes of '
           'answers."""', "", "import ctypes", "from ctypes import c_char_p, c_double, c_int, c_size_t, c_ssize_t, "
           "c_void_p", "from dataclasses import dataclass", "from enum import IntEnum", "",
            "import numpy as np", "from numpy.typing import NDArray", "", "from tangency._columns import Column, Columns", ""]
    for enum in table.ENUMS:
        out += ["", f"class {enum.python or camel(enum.name)}(IntEnum):"]
        out += docstring(enum.doc, "    ")
        out += [f"    {m} = {v}" for v, (m, _) in enumerate(enum.members)] + [""]
    for struct in table.STRUCTS:
        out += ["", f"class {camel(struct.name)}Struct(ctypes.Structure):", "    _fields_ = ["]
        out.append('        ("size", c_size_t),')
        out += [f'        ("{i.name}", {ctypes_of(Type(i.type))}),' for i in struct.fields]
        out += ["    ]", ""]
    for struct in table.STRUCTS:
        if not struct.python:
            continue
        out += ["", "@dataclass(init=False, repr=False, eq=False)",
                f"class {struct.python}(Columns):"] + class_docstring(struct)
        out += [f"    {i.name}: NDArray[np.{NUMPY_OF[Type(i.type).base]}]" for i in struct.fields] + [""]
        out += [f"    struct = {camel(struct.name)}Struct", "    fields = ("]
        for item in struct.fields:
            kind = Type(item.type)
            enum = next((e.python for e in table.ENUMS if e.name == item.enum), None)
            out.append(f'        Column("{item.name}", "{NUMPY_OF[kind.base]}", {kind.shape!r}, {enum}),')
        out += ["    )", ""]
    out += ["", "FUNCTIONS = {"]
    for function in table.FUNCTIONS:
        result = {"int": "c_int", "size_t": "c_size_t", "const char*": "c_char_p", "void": "None"}[function.returns]
        arguments = ", ".join(ctypes_of(Type(a.type)) for a in function.arguments)
        out += textwrap.wrap(f'"{function.name}": ({result}, [{arguments}]),', 98, initial_indent="    ",
                             subsequent_indent="        ")
    out.append("}")
    return "\n".join(out) + "\n"


def docstring(text, indent):
    if len(text) < 84:
        return [f'{indent}"""{text}"""', ""]
    lines = wrapped(text, indent, 96)
    lines[0] = f'{indent}"""' + lines[0].strip()
    return lines + [f'{indent}"""', ""]


def class_docstring(struct):
    lines = wrapped(struct.doc.replace("tangency_", "").replace("()", ""), "    ", 94)
    out = [f'    """{lines[0].strip()}'] + lines[1:]
    out += ["", "    Attributes", "    ----------"]
    for item in struct.fields:
        kind = Type(item.type)
        shape = ", ".join(["N", *map(str, kind.shape)]) + ("," if not kind.shape else "")
        out.append(f"    {item.name} : ndarray of {NUMPY_OF[kind.base]}, shape ({shape})")
        enum = next((e.python for e in table.ENUMS if e.name == item.enum), None)
        text = f"Values of {enum}." if enum else item.doc
        text += f" ({item.unit})" if item.unit not in ("", "1") else ""
        out += wrapped(text, "        ", 94)
    return out + ['    """', ""]


def python_stub():
    out = [f"# {LICENCE}", f"# {MARK}", "import ctypes", "from dataclasses import dataclass", "from enum import IntEnum", "from typing import Any", "",
           "import numpy as np", "from numpy.typing import NDArray", "", "from tangency._columns import Columns", ""]
    for enum in table.ENUMS:
        out.append(f"class {enum.python or camel(enum.name)}(IntEnum):")
        out += [f"    {m} = {v}" for v, (m, _) in enumerate(enum.members)] + [""]
    for struct in table.STRUCTS:
        out.append(f"class {camel(struct.name)}Struct(ctypes.Structure):")
        out.append("    size: int")
        python = {"double": "float", "int": "int"}
        out += [f"    {i.name}: {python.get(i.type, 'int | None')}" for i in struct.fields] + [""]
    for struct in table.STRUCTS:
        if struct.python:
            out += ["@dataclass(init=False, repr=False, eq=False)", f"class {struct.python}(Columns):"]
            for item in struct.fields:
                out.append(f"    {item.name}: NDArray[np.{NUMPY_OF[Type(item.type).base]}]")
            out.append("")
    out.append("FUNCTIONS: dict[str, tuple[Any, list[Any]]]")
    return "\n".join(out) + "\n"


def require_rules():
    """What holds for the table as a whole.

    Raises
    ------
    ValueError
        A struct that ends with padding, where a field of a later version would lie within sizeof.
        Pairs of bodies that are described as of a body and another thing, or the other way round.
    """
    for struct in table.STRUCTS:
        if size_of(struct) % 8 != 0:
            raise ValueError(f"{struct.name}: ends with 4 bytes of padding: add _RESERVED")
    for function in table.FUNCTIONS:
        names = [a.name for a in function.arguments]
        has_others = any(name.endswith("_count") for name in names)
        for argument in function.arguments:
            if argument.name == "pairs" and (argument in table._MEETINGS) != has_others:
                raise ValueError(f"{function.name}: pairs: are of {'others' if has_others else 'bodies'}, "
                                 f"which \"{argument.doc}\" does not say")


FILES = {
    "c/tangency.h": c_header,
    "c/same_values.hpp": same_values,
    "fortran/tangency.f90": fortran_module,
    "python/tangency/_table.py": python_prototypes,
    "python/tangency/_table.pyi": python_stub,
}


def main():
    require_rules()
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    for name, write in FILES.items():
        path = folder / name
        text = write()
        if not path.exists() or path.read_text() != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            print(name)


if __name__ == "__main__":
    main()
