#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The house's dialect: what CONTRIBUTING.md says of names and includes, held to every C++ file.

Includes: a source names its own header first; then stand the headers of other libraries, those of
the standard library, this project's and the neighbours of the file, each group sorted and apart from
the next. A file includes the standard header of every std:: name that it uses, or its own header does.
Names: types are CamelCase, functions and variables snake_case, namespace-scope constants kCamelCase,
macros UPPER_CASE; a header says what it is for under `/// @file`; tests lie in tangency::testing or
in no namespace of the project's own.

Usage: dialect.py ROOT [--mend]
Prints what departs from it, and ends with 1 where anything does. --mend sorts the includes and adds
the standard headers that are missing; names are left to the reader.
"""

import argparse
import os
import re
import sys

from cpp_text import Source

FOLDERS = ("geometry", "dem", "verify", "bench", "tests")

# The standard header of a name of std; where several serve, any of them does.
STANDARD = {
    "algorithm": """all_of any_of none_of find find_if count count_if copy copy_if fill fill_n generate
        transform sort stable_sort nth_element partition unique reverse rotate shuffle min max minmax
        clamp min_element max_element minmax_element lower_bound upper_bound equal_range binary_search
        is_sorted remove_if for_each equal mismatch search set_difference next_permutation replace
        is_permutation partial_sort merge adjacent_find find_if_not remove iter_swap""",
    "array": "array to_array",
    "atomic": "atomic atomic_flag memory_order_relaxed",
    "bit": "bit_cast bit_width countr_zero countl_zero has_single_bit endian popcount",
    "charconv": "from_chars to_chars chars_format",
    "chrono": "chrono",
    "cmath": """sqrt cbrt hypot pow exp log log2 log10 log1p expm1 sin cos tan asin acos atan atan2 sinh
        cosh tanh fma floor ceil round trunc lround llround rint nearbyint isfinite isnan isinf signbit
        copysign nextafter scalbn scalbln ldexp frexp ilogb logb fmod remainder fmin fmax fdim fabs erf
        isnormal fpclassify modf""",
    "condition_variable": "condition_variable",
    "cerrno": "errno",
    "csignal": "signal raise sig_atomic_t",
    "cstdint": """int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t uintptr_t intptr_t
        uint_fast32_t""",
    "cstdio": """printf fprintf snprintf fopen fclose fputs fputc puts fwrite fread fflush FILE remove
        rename perror vsnprintf putchar ferror""",
    "cstdlib": "exit abort getenv malloc free aligned_alloc strtod strtol atexit quick_exit system",
    "cstring": "memcpy memcmp memset memmove strcmp strlen strerror strncmp strchr strrchr strsignal",
    "deque": "deque",
    "exception": """exception exception_ptr current_exception rethrow_exception terminate
        uncaught_exceptions""",
    "filesystem": "filesystem",
    "fstream": "ifstream ofstream fstream filebuf",
    "functional": "function bind ref cref hash less greater plus invoke multiplies reference_wrapper",
    "future": "async future promise launch",
    "initializer_list": "initializer_list",
    "iomanip": "setprecision setw setfill quoted hexfloat_ put_time",
    "iostream": "cout cerr cin clog",
    "iterator": """back_inserter istreambuf_iterator istream_iterator ostream_iterator distance advance
        next prev make_move_iterator""",
    "limits": "numeric_limits",
    "list": "list",
    "map": "map multimap",
    "memory": """unique_ptr shared_ptr weak_ptr make_unique make_shared addressof allocator construct_at
        destroy_at assume_aligned""",
    "mutex": "mutex lock_guard unique_lock scoped_lock once_flag call_once",
    "new": "bad_alloc nothrow launder",
    "numbers": "numbers",
    "numeric": "accumulate iota inner_product reduce gcd lcm partial_sum midpoint transform_reduce",
    "optional": "optional nullopt make_optional nullopt_t",
    "queue": "queue priority_queue",
    "random": """mt19937 mt19937_64 uniform_real_distribution uniform_int_distribution
        normal_distribution random_device discrete_distribution minstd_rand""",
    "ratio": "ratio milli micro nano",
    "regex": "regex regex_search regex_match smatch regex_replace sregex_iterator",
    "set": "set multiset",
    "span": "span dynamic_extent",
    "sstream": "ostringstream istringstream stringstream",
    "stdexcept": """runtime_error logic_error invalid_argument out_of_range domain_error length_error
        overflow_error range_error""",
    "string": """string to_string getline stoi stod stol stoull stoll char_traits basic_string""",
    "string_view": "string_view basic_string_view",
    "system_error": "error_code system_error errc make_error_code generic_category system_category",
    "thread": "thread this_thread jthread",
    "tuple": "tuple tie make_tuple apply forward_as_tuple ignore tuple_size",
    "type_traits": """is_same_v is_same decay_t remove_cvref_t enable_if_t conditional_t conditional
        true_type false_type is_integral_v is_floating_point_v invoke_result_t is_nothrow_invocable_v
        is_trivially_copyable_v void_t underlying_type_t is_arithmetic_v is_const_v
        is_nothrow_move_constructible_v is_default_constructible_v is_void_v type_identity_t
        remove_reference_t is_enum_v is_convertible_v is_standard_layout_v is_constructible_v
        is_assignable_v is_rvalue_reference_v is_lvalue_reference_v""",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "utility": """move forward pair make_pair exchange swap declval as_const in_place index_sequence
        make_index_sequence integer_sequence unreachable to_underlying""",
    "variant": "variant visit holds_alternative get_if monostate",
    "vector": "vector",
    "concepts": "same_as invocable floating_point integral convertible_to derived_from",
    "complex": "complex norm conj",
    "cfenv": "fesetround fegetround feclearexcept fetestexcept fenv_t fegetenv fesetenv feholdexcept",
    "cctype": "isspace isdigit isalpha isalnum toupper tolower isprint ispunct isxdigit",
    "locale": "locale",
    "ctime": "time_t tm strftime gmtime gmtime_r time",
    "ostream": "ostream flush endl",
    "istream": "istream ws",
    "ios": "ios ios_base hexfloat defaultfloat fixed scientific streamsize showpos",
}
OTHERS = {  # further headers that serve, for a header above
    "cmath": {"complex"},
    "ostream": {"iostream", "sstream", "fstream", "iomanip"},
    "istream": {"iostream", "sstream", "fstream"},
    "ios": {"iostream", "sstream", "fstream", "ostream", "istream", "iomanip"},
    "string_view": {"string"},
    "iterator": {"array", "deque", "list", "map", "set", "span", "string", "string_view", "vector"},
    "initializer_list": {"array", "map", "set", "string", "utility", "vector", "algorithm"},
    "cstdlib": {"cmath"},
}
HEADER_OF = {}
for header, names in STANDARD.items():
    for name in names.split():
        HEADER_OF.setdefault(name, set()).add(header)
HEADER_OF["size_t"] = {"cstddef", "cstdio", "cstdlib", "cstring"}
HEADER_OF["ptrdiff_t"] = HEADER_OF["byte"] = HEADER_OF["max_align_t"] = {"cstddef"}
HEADER_OF["nullptr_t"] = {"cstddef"}
HEADER_OF["get"] = {"array", "tuple", "utility", "variant"}  # and whatever has the type
HEADER_OF["abs"] = {"cmath", "cstdlib"}
HEADER_OF["size"] = HEADER_OF["begin"] = HEADER_OF["end"] = HEADER_OF["data"] = set()

INCLUDE = re.compile(r'#\s*include\s+([<"])([^>"]+)[>"](.*)$')
CAMEL = re.compile(r"[A-Z][A-Za-z0-9]*$")
C_NAME = re.compile(r"tangency_[a-z_]+$")  # an opaque type of the C interface, in its folder
C_FOLDER = "geometry/bindings/c/"
SNAKE = re.compile(r"[a-z][a-z0-9_]*$")
CONSTANT = re.compile(r"k[A-Z0-9][A-Za-z0-9]*$")
MACRO = re.compile(r"[A-Z][A-Z0-9_]*$")


def group(mark, name):
    """The place of a header: another library's, the standard's, this project's, a neighbour."""
    if mark == '"':
        return 3
    if name.startswith("tangency/"):
        return 2
    return 1 if re.fullmatch(r"[a-z_0-9]+", name) else 0


def own_header(path):
    return "tangency/" + os.path.splitext(path)[0] + ".hpp"


class File:
    def __init__(self, root, path):
        self.root, self.path = root, path
        with open(os.path.join(root, path), encoding="utf-8") as file:
            self.text = file.read()
        self.lines = self.text.split("\n")
        self.source = Source(self.text)
        self.is_header = path.endswith(".hpp")
        self.has_own_header = not self.is_header and os.path.exists(
            os.path.join(root, os.path.splitext(path)[0] + ".hpp"))

    def includes(self):
        return {found.group(2) for line in self.lines if (found := INCLUDE.match(line))}

    def block(self):
        """The first run of lines that are empty or includes: its first and its last line, or None."""
        first = next((i for i, line in enumerate(self.lines) if INCLUDE.match(line)), None)
        if first is None:
            return None
        last, i = first, first
        while i < len(self.lines) and (not self.lines[i] or INCLUDE.match(self.lines[i])):
            last = i if self.lines[i] else last
            i += 1
        return first, last

    def sorted_block(self, extra=()):
        """The lines of the block as they should be, with the headers of `extra` added."""
        first, last = self.block()
        own, groups = [], [[], [], [], []]
        lines = [line for line in self.lines[first:last + 1] if line]
        for line in dict.fromkeys(lines + [f"#include <{name}>" for name in extra]):
            found = INCLUDE.match(line)
            mark, name = found.group(1), found.group(2)
            is_own = self.has_own_header and (
                name == own_header(self.path) or
                mark == '"' and name == os.path.basename(own_header(self.path)))
            (own if is_own else groups[group(mark, name)]).append(line)
        parts = [part for part in [own] + [sorted(g, key=lambda l: INCLUDE.match(l).group(2))
                                           for g in groups] if part]
        return "\n\n".join("\n".join(part) for part in parts).split("\n")

    def missing(self, own_includes):
        """The standard headers that no include of the file or of its own header names."""
        have = self.includes() | own_includes
        if any(name.startswith("hwy/") for name in have) and self.path.endswith("-inl.hpp"):
            return set()
        absent = set()
        tokens = self.source.tokens
        for i in range(2, len(tokens)):
            if tokens[i].kind != "name" or tokens[i - 1].text != "::" or tokens[i - 2].text != "std":
                continue
            serving = HEADER_OF.get(tokens[i].text)
            if not serving:
                continue
            every = serving.union(*(OTHERS.get(header, ()) for header in serving))
            if not every & have:
                absent.add(min(serving))
        return absent


def departures_of_names(file):
    """What is named otherwise than the house names it: line and words."""
    tokens, source = file.source.tokens, file.source
    for i, token in enumerate(tokens):
        before = tokens[i - 1].text if i else ""
        after = source.text_at(i + 1)
        if token.kind != "name":
            continue
        if (before in ("class", "struct", "union", "enum") and after in ("{", ":", "final", ";") and
                not CAMEL.match(token.text) and not (file.path.startswith(C_FOLDER) and C_NAME.match(token.text))):
            yield token.line, f"type {token.text}: CamelCase"
        if (before == "using" and after == "=" and not CAMEL.match(token.text) and
                token.text not in ALIASES and source.text_at(i - 2) != ">"):
            yield token.line, f"alias {token.text}: CamelCase"
        if before == "namespace" and not SNAKE.match(token.text) and token.text not in LIBRARIES:
            yield token.line, f"namespace {token.text}: snake_case"
        at_namespace = source.around[i] is None or source.scope[source.around[i]] == "namespace"
        if at_namespace and before not in ("::", "namespace", "."):
            statement = _statement(source, i)
            declared = _declared_constant(source, statement, i)
            if declared and not CONSTANT.match(token.text):
                yield token.line, f"constant {token.text}: kCamelCase"
        if source.in_enum(i) and before in ("{", ",") and not (
                SNAKE.match(token.text) or CONSTANT.match(token.text)):
            yield token.line, f"enumerator {token.text}: snake_case, or kCamelCase for a number"
    for number, line in enumerate(file.lines, 1):
        found = re.match(r"#\s*define\s+(\w+)", line)
        if found and not MACRO.match(found.group(1)):
            yield number, f"macro {found.group(1)}: UPPER_CASE"


# What the standard library asks of a container, an iterator or an allocator.
LIBRARIES = {"CLI"}  # whose types a header declares in place of including them
ALIASES = {"value_type", "size_type", "difference_type", "pointer", "reference", "iterator",
           "const_iterator", "iterator_category", "result_type", "is_always_equal"}


def _statement(source, i):
    """Where the declaration begins that token i stands in."""
    k = i
    while k > 0 and source.text_at(k - 1) not in (";", "{", "}"):
        k -= 1
    return k


def _declared_constant(source, begin, i):
    """Is token i the name that a `constexpr TYPE NAME = ...` declares, or a `const` one?"""
    head = [source.text_at(k) for k in range(begin, i)]
    if "constexpr" not in head or "(" in head or "=" in head and "," not in head or "using" in head:
        return False
    if "operator" in head or "struct" in head or "class" in head:
        return False
    if not head or head[-1] in ("<", ",", "::") and "=" not in head:
        return False
    if source.tokens[i].text in ("const", "constexpr", "inline", "static", "auto") or i in source.in_angles:
        return False
    previous = source.tokens[i - 1]
    names_before = [t for t in head if t not in ("constexpr", "inline", "static", "const", "thread_local")]
    return bool(names_before) and (previous.kind == "name" or previous.text in (">", "*", "&")) and \
        source.text_at(i + 1) in ("=", "{", "[", ";") and previous.text not in ("return",)


def files_of(root):
    for folder in FOLDERS:
        for place, _, names in os.walk(os.path.join(root, folder)):
            for name in sorted(names):
                if name.endswith((".hpp", ".cpp")):
                    yield os.path.relpath(os.path.join(place, name), root)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("root")
    parser.add_argument("--mend", action="store_true")
    arguments = parser.parse_args()
    files = {path: File(arguments.root, path) for path in sorted(files_of(arguments.root))}
    if not files:
        sys.exit(f"{arguments.root} holds no C++ file")
    count = 0

    def report(path, line, what):
        nonlocal count
        count += 1
        print(f"{path}:{line}: {what}")

    for path, file in files.items():
        own = files.get(os.path.splitext(path)[0] + ".hpp") if file.has_own_header else None
        missing = sorted(file.missing(own.includes() if own else set()))
        block = file.block()
        if block:
            wanted = file.sorted_block(missing if arguments.mend else ())
            if wanted != file.lines[block[0]:block[1] + 1]:
                if arguments.mend:
                    file.lines[block[0]:block[1] + 1] = wanted
                    with open(os.path.join(arguments.root, path), "w", encoding="utf-8") as out:
                        out.write("\n".join(file.lines))
                else:
                    report(path, block[0] + 1, "includes out of order; --mend sorts them")
        if missing and not (arguments.mend and block):
            report(path, 1, "uses and does not include " + " ".join(f"<{m}>" for m in missing))
        if file.is_header and "/// @file" not in file.text:
            report(path, 1, "says under no /// @file what it is for")
        if file.is_header and "#pragma once" not in file.text and not path.endswith("-inl.hpp"):
            report(path, 1, "has no #pragma once")
        if path.startswith("tests/"):
            for number, line in enumerate(file.lines, 1):
                if re.match(r"namespace tangency::(test|tests)\b", line):
                    report(path, number, "tests lie in tangency::testing")
        for line, what in departures_of_names(file):
            report(path, line, what)
    print(f"{len(files)} files, {count} departures")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
