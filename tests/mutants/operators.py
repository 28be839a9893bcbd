# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: every change that one of them can make to a C++ text.

sign                a + b <-> a - b, += <-> -=, -a -> a
index               a[0] -> a[1], a[i] -> a[0], v.x -> v.y, p.low -> p.high
comparison          < -> <= or >=, == <-> !=, && <-> ||, !a -> a
constant            n -> n + 1, n - 1 or 0; x -> x + 1, x - 1, 0 or -x
dropped statement   an assignment, a call, an `if` with its one statement, a break -> nothing
swapped argument    f(a, b) -> f(b, a), of calls and of values in braces

Comments, strings, directives, assertions, template arguments, enumerators and parameter lists stay
as they are, as do the arguments of functions that do not care for their order.
"""
import dataclasses
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "build"))
from cpp_text import ASSERTING, Source

OPERATORS = ("sign", "index", "comparison", "constant", "dropped statement", "swapped argument")
COMPARISONS = {"<": ("<=", ">="), ">": (">=", "<="), "<=": ("<", ">"), ">=": (">", "<"),
               "==": ("!=",), "!=": ("==",), "&&": ("||",), "||": ("&&",)}
SIGNS = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
COMPONENTS = {"x": "y", "y": "z", "z": "x", "xx": "yy", "yy": "zz", "zz": "xx", "yz": "zx",
              "zx": "xy", "xy": "yz", "low": "high", "high": "low", "first": "second",
              "second": "first"}
SYMMETRIC = {"min", "max", "swap", "dot", "gcd", "hypot"}
NO_CALL = {"if", "for", "while", "switch", "return", "catch", "sizeof", "alignof", "decltype",
           "noexcept", "operator", "constexpr"} | ASSERTING
NO_START = {"const", "auto", "using", "static", "constexpr", "return", "case", "default", "else",
            "do", "switch", "try", "goto", "typename", "template", "struct", "class", "enum",
            "friend", "namespace", "extern", "public", "private", "protected"} | ASSERTING
ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}


@dataclasses.dataclass(frozen=True)
class Change:
    operator: str
    begin: int
    end: int
    text: str  # what stands there instead
    line: int
    in_function: bool

    def applied_to(self, text):
        return text[:self.begin] + self.text + text[self.end:]


def changes(text):
    """Every change to a text, by place."""
    source = Source(text)
    found = []
    for i, token in enumerate(source.tokens):
        if i in source.in_assert or i in source.in_angles or source.in_enum(i):
            continue
        for operator, of_token in OF_A_TOKEN.items():
            for begin, end, new in of_token(source, i):
                found.append((operator, begin, end, new, token.line, source.in_block(i)))
    for opening, kind in source.scope.items():
        if kind == "block":
            for first, last in _statements(source, opening):
                found.append(_without(source, first, last))
    return sorted((Change(*f) for f in found), key=lambda c: (c.begin, c.end, c.operator, c.text))


def _signs(source, i):
    t = source.tokens[i]
    if t.text in SIGNS and source.spaced(i):
        yield t.begin, t.end, SIGNS[t.text]
    elif t.text == "-" and not source.text[t.end].isspace() and source.text_at(i - 1) != "operator":
        yield t.begin, t.end, ""


def _index_value(source, i):
    """Is this number alone in the brackets of a subscript, or does it name a column or a row?"""
    if source.text_at(i - 1) == "[" and source.text_at(i + 1) == "]":
        return not _declares(source, i - 1)
    return (source.text_at(i - 1) == "(" and source.text_at(i + 1) == ")" and
            source.text_at(i - 2) in ("col", "row"))


def _declares(source, bracket):
    """Does this square bracket give the size of an array, or open a lambda or an attribute?"""
    before = source.text_at(bracket - 1)
    if not re.fullmatch(r"[\w)\]]+", before) or before == "return":
        return True
    kind = source.tokens[bracket - 2].kind if bracket >= 2 else ""
    return before not in (")", "]") and (
        kind == "name" and source.text_at(bracket - 2) != "return" or
        source.text_at(bracket - 2) in (">", "*") and not source.spaced(bracket - 2))


def _indices(source, i):
    t = source.tokens[i]
    if t.kind == "number" and t.text.isdigit() and _index_value(source, i):
        n = int(t.text)
        for other in ((n + 1) % 3, (n + 2) % 3) if n < 3 else (n - 1, n + 1):
            yield t.begin, t.end, str(other)
    elif t.text == "[" and i in source.match and not _declares(source, i):
        begin, end = t.end, source.tokens[source.match[i]].begin
        if end > begin and not source.text[begin:end].isdigit():
            yield begin, end, "0"
    elif t.text in COMPONENTS and source.text_at(i - 1) == ".":
        yield t.begin, t.end, COMPONENTS[t.text]


def _comparisons(source, i):
    t = source.tokens[i]
    if t.text in COMPARISONS and source.spaced(i) and source.text_at(i - 1) not in (
            "operator", "template"):
        for other in COMPARISONS[t.text]:
            yield t.begin, t.end, other
    elif t.text == "!" and source.text_at(i - 1) != "operator":
        yield t.begin, t.end, ""


def _constants(source, i):
    t = source.tokens[i]
    pure = source.text_at(i - 1) == "=" and source.text_at(i - 2) in (")", "const", "noexcept",
                                                                      "override")
    if t.kind != "number" or _index_value(source, i) or pure or (
            source.text_at(i - 1) == "[" and _declares(source, i - 1)):
        return
    if not re.search(r"^0[xX].*[pP]|^[^xX]*[.eE]", t.text):
        digits = re.match(r"0[xX][\da-fA-F']+|[\d']+", t.text).group().replace("'", "")
        value = int(digits, 0 if digits[:2] in ("0x", "0X") else 10)
        others = [f"({t.text} + 1)", f"({t.text} - 1)", "0"] if value > 1 else (
            ["0", "2"] if value == 1 else ["1"])
    else:
        hexadecimal = t.text[:2] in ("0x", "0X")
        value = float.fromhex(t.text) if hexadecimal else float(t.text.rstrip("fFlL"))
        others = [f"({t.text} {sign} 1.0)" for sign in "+-" if value + float(sign + "1") != value]
        if value != 0:
            others += ["0.0"] if value != 1 else []
            others += [f"(-{t.text})"]
    for other in others:
        yield t.begin, t.end, other


def _swaps(source, i):
    t = source.tokens[i]
    before = source.text_at(i - 1)
    if i not in source.match or not source.in_block(i):
        return
    is_call = t.text == "(" and before not in NO_CALL and before not in SYMMETRIC and (
        re.fullmatch(r"[A-Za-z_]\w*", before) and not re.fullmatch(r"[A-Z][A-Z0-9_]+", before))
    is_value = t.text == "{" and source.scope.get(i) == "value"
    if not is_call and not is_value:
        return
    arguments = _arguments(source, i)
    for (b0, e0), (b1, e1) in zip(arguments, arguments[1:]):
        one, other = source.text[b0:e0], source.text[b1:e1]
        if one != other and one and other:
            yield b0, e1, other + source.text[e0:b1] + one


def _arguments(source, opening):
    """Where the values between two brackets begin and end."""
    found, first, k = [], opening + 1, opening + 1
    closing = source.match[opening]
    while k <= closing:
        if k == closing or (source.text_at(k) == "," and k not in source.in_angles):
            if k > first:
                found.append((source.tokens[first].begin, source.tokens[k - 1].end))
            first = k + 1
        k = source.match.get(k, k) + 1
    return found


def _statements(source, opening):
    """Of a block, the first and last token of each statement that can be left out."""
    k, closing = opening + 1, source.match[opening]
    spans = []
    while k < closing:
        first, compound = k, False
        while k < closing and source.text_at(k) != ";":
            if k in source.match:
                compound = source.scope.get(k) not in (None, "value")
                k = source.match[k]
                if compound and source.text_at(k + 1) not in (";", ",", ")", "(", ".", "?", ":"):
                    break
            k += 1
        spans.append((first, min(k, closing - 1), compound))
        k += 1
    for (first, last, compound), after in zip(spans, spans[1:] + [(closing, closing, False)]):
        if not compound and source.text_at(after[0]) != "else" and _can_go(source, first, last):
            yield first, last


def _can_go(source, first, last):
    start, kind = source.text_at(first), source.tokens[first].kind
    if source.text_at(last) != ";" or first in source.in_assert:
        return False
    if start in ("if", "for", "while", "continue", "break", "throw", "++", "--"):
        return last > first
    if start in NO_START or re.fullmatch(r"[A-Z][A-Z0-9_]+", start) or (
            kind != "name" and start not in ("(", "*")):
        return False
    k, head, assigns = first, [], False
    while k < last:
        if source.text_at(k) in ASSIGNMENTS:
            assigns = True
            break
        head.append(k)
        if source.text_at(k) == "(" and head[1:] and not assigns and k != first:
            k = source.match[k]
            head.append(k)
            k += 1
            continue
        k = source.match.get(k, k) + 1
    declares = any(
        source.tokens[j].kind == "name" and j - 1 >= first and
        (source.tokens[j - 1].kind == "name" or source.text_at(j - 1) in (">", "&", "*"))
        for j in head[1:] if source.text_at(j - 1) != "]")
    calls = source.text_at(last - 1) == ")" or source.text_at(first + 1) in ("++", "--")
    return not declares and (assigns or calls)


def _without(source, first, last):
    begin, end = source.tokens[first].begin, source.tokens[last].end
    newlines = source.text.count("\n", begin, end)
    return "dropped statement", begin, end, ";" + "\n" * newlines, source.tokens[first].line, True


OF_A_TOKEN = {"sign": _signs, "index": _indices, "comparison": _comparisons,
              "constant": _constants, "swapped argument": _swaps}
