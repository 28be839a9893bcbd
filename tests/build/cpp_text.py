# SPDX-License-Identifier: GPL-3.0-or-later
"""C++ text as tokens, brackets and scopes: as much of the language as the operators need.

It leans on the house's formatting: a comparison has a space on either side, the bracket of a
template has none before it.
"""
import dataclasses
import re

KIND_OF_GROUP = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<directive>(?<![^\n])[ \t]*\#(?:[^\n\\]|\\.|\\\n)*)
      | (?P<string>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+')
      | (?P<number>0[xX][0-9a-fA-F']*(?:\.[0-9a-fA-F]*)?(?:[pP][+-]?\d+)?[a-zA-Z]*
                  |(?:\d[\d']*\.?[\d']*|\.\d+)(?:[eE][+-]?\d+)?[a-zA-Z]*)
      | (?P<name>[A-Za-z_]\w*)
      | (?P<sign><=>|<<=|>>=|->\*|\.\.\.|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[^\s\w])
    """,
    re.VERBOSE | re.DOTALL)
CLOSING = {"(": ")", "[": "]", "{": "}"}
TYPE_WORDS = {"class", "struct", "union", "enum"}
ASSERTING = {"assert", "static_assert"}


@dataclasses.dataclass
class Token:
    kind: str  # "string", "number", "name" or "sign"
    text: str
    begin: int
    end: int
    line: int  # from 1


class Source:
    """The tokens of a text without comments and directives, and what encloses each of them."""

    def __init__(self, text):
        self.text = text
        self.tokens = list(_tokens(text))
        self.match = _matching(self.tokens)  # of an opening bracket's index, its closing one's
        self.scope = {}  # of an opening brace's index: "namespace", "type", "block" or "value"
        self.around = []  # of each token: the innermost brace around it that is no value, or None
        self._find_scopes()
        self.in_assert = self._inside(
            i + 1 for i, t in enumerate(self.tokens) if t.text in ASSERTING)
        self.in_angles = self._angles()

    def text_at(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def in_block(self, i):
        return self.around[i] is not None and self.scope[self.around[i]] == "block"

    def in_enum(self, i):
        return self.around[i] is not None and self.scope[self.around[i]] == "enum"

    def spaced(self, i):
        """Is there white space on either side?"""
        t = self.tokens[i]
        return self.text[t.begin - 1].isspace() and self.text[t.end].isspace()

    def _inside(self, openings):
        inside = set()
        for i in openings:
            if i in self.match:
                inside.update(range(i, self.match[i] + 1))
        return inside

    def _find_scopes(self):
        closings = []
        for i, t in enumerate(self.tokens):
            if closings and i == closings[-1][1]:
                closings.pop()
            self.around.append(closings[-1][0] if closings else None)
            if t.text == "{" and i in self.match:
                self.scope[i] = self._kind_of_brace(i)
                if self.scope[i] != "value":
                    closings.append((i, self.match[i]))

    def _kind_of_brace(self, i):
        head = []
        k = i - 1
        while k >= 0 and self.text_at(k) not in (";", "{", "}"):
            head.append(self.text_at(k))
            k -= 1
        head.reverse()
        if "namespace" in head[:2]:
            return "namespace"
        words = [w for w in head if w in TYPE_WORDS]
        if words and "(" not in head and "=" not in head:
            return "enum" if words[0] == "enum" else "type"
        before = self.text_at(i - 1)
        if before in (")", "else", "do", "try", "const", "noexcept", "override", "mutable"):
            return "block"
        if before == "]" or re.fullmatch(r"[A-Z]+_ATTR", before):
            return "block"  # a lambda
        if before in ("{", "}", ";", ""):
            return "block" if self._in_open_block(i) and before != "{" else "value"
        k = i - 1  # a lambda's or a function's result type behind an arrow
        while k >= 0 and (self.tokens[k].kind == "name" or self.text_at(k) in ("::", "<", ">", "*")):
            k -= 1
        return "block" if self.text_at(k) == "->" and self.text_at(k - 1) == ")" else "value"

    def _in_open_block(self, i):
        around = self.around[i] if i < len(self.around) else None
        return around is not None and self.scope[around] == "block"

    def _angles(self):
        """Tokens between the angle brackets of templates."""
        inside = set()
        for i, t in enumerate(self.tokens):
            opens = t.text == "<" and (self.text_at(i - 1) == "template" or (
                self.tokens[i - 1].kind == "name" and self.tokens[i - 1].end == t.begin and
                self.text_at(i - 1) != "operator"))
            if not opens:
                continue
            depth, k = 0, i
            while k < len(self.tokens) and self.text_at(k) not in (";", "{"):
                depth += {"<": 1, ">": -1, ">>": -2}.get(self.text_at(k), 0)
                if depth <= 0:
                    inside.update(range(i, k + 1))
                    break
                k += 1
        return inside


def _tokens(text):
    line, last = 1, 0
    for found in KIND_OF_GROUP.finditer(text):
        kind = found.lastgroup if found.lastgroup != "mark" else "string"
        if kind in ("comment", "directive"):
            continue
        line += text.count("\n", last, found.start())
        last = found.start()
        yield Token(kind, found.group(), found.start(), found.end(), line)


def _matching(tokens):
    match, open_ones = {}, []
    for i, t in enumerate(tokens):
        if t.kind != "sign":
            continue
        if t.text in CLOSING:
            open_ones.append(i)
        elif open_ones and t.text == CLOSING[tokens[open_ones[-1]].text]:
            match[open_ones.pop()] = i
    return match
