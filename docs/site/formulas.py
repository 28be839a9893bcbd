# SPDX-License-Identifier: MIT
"""Formulas of derivations, which are plain text in the sources, for AsciiMath and for running text."""
import re

GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "eta": "η", "theta": "θ", "kappa": "κ",
         "lambda": "λ", "mu": "μ", "nu": "ν", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "chi": "χ",
         "psi": "ψ", "omega": "ω"}
# Names that AsciiMath sets as functions.
FUNCTIONS = {"sin", "cos", "tan", "sqrt", "min", "max", "log", "exp", "det", "sum", "sinh", "cosh", "tanh", "arcsin", "arccos",
             "arctan", "sgn"}
# Signs of AsciiMath that this module writes itself.
SIGNS = {"ox", "xx", "qquad", "int"}
NAMES = {"integral": "int", "asin": "arcsin", "acos": "arccos", "atan": "arctan"}
# Short words of English and names; others of two letters are products.
WORDS = {"of", "or", "if", "by", "is", "in", "on", "at", "to", "as", "no", "tr", "per"}
COMMAND = re.compile(r"^\s*(build/|bench/|tests/|tangency|python3|cmake|ctest|git |\./|\.ci|env )|\s--\w")


def is_formula(lines):
    """Is a block by indentation mathematics, and no command or program?"""
    return not any(COMMAND.search(line) or ";" in line and "{" in line for line in lines)


def is_word(name):
    """Is it a word or a name, and no product such as nAn?"""
    if name in WORDS:
        return True
    product = len(name) < 5 and (not re.search("[aeiouy]", name) or re.search("[A-Z]", name[1:]))
    return len(name) > 2 and len(set(name)) > 1 and not product


def word(match):
    name = match[0]
    if name in NAMES:
        return f" {NAMES[name]} "
    if name in GREEK or name in FUNCTIONS or name in SIGNS:
        return f" {name} "
    # AsciiMath has signs named nn, uu, vv: letters of a product stand apart.
    return f' \\ "{name}" \\ ' if is_word(name) else " ".join(name)


def script(match):
    """A whole subscript or exponent, where AsciiMath would take its first letter."""
    sign, text = match[1], match[2]
    if set(text) <= set("ijklmn"):
        return f"{sign}({' '.join(text)})"
    if is_word(text) and text not in GREEK and text.isalpha():
        return f'{sign}("{text}")'
    return f"{sign}({text})" if len(text) > 1 else sign + text


OPERAND = r"(?:[A-Za-z]?[\w.]*(?:[_^](?:\([^()]*\)|\w+))*'*|\([^()]*\)|\|[^|]*\|)"
FRACTION = re.compile(rf"(?<![\w)|'])({OPERAND}) ?/ ?({OPERAND})(?=\s*(?:$|[)+=,;<]|- |\||qquad))")


def fractions(text):
    """A slash becomes a fraction where nothing beside it could be taken for a part of it; else it stays a slash."""
    parts, at = [], 0
    for match in FRACTION.finditer(text):
        before = text[:match.start()].rstrip()
        alone = not before or before[-1] in "(+-=,|<" or before.endswith("qquad")
        if alone and match[1] and match[2]:
            parts += [text[at:match.start()].replace("/", "//"), "/".join(f"({part})" if len(part) > 1 and part.isalpha() else part for part in match.groups())]
            at = match.end()
    return "".join(parts) + text[at:].replace("/", "//")


def set_formula(line):
    """A line of plain mathematics for AsciiMath. Columns are told apart by three spaces or more."""
    text = line.strip()
    text = re.sub(r" {3,}", " qquad ", text)
    text = text.replace("[]", "").replace("~", "^(~)").replace("(x)", " ox ").replace(" x ", " xx ").replace(" . ", " * ")
    text = re.sub(r"(?<![\w.])([A-Za-z]'?)\.(?=[A-Za-z]\b|[A-Za-z]_)", r"\1 * ", text)
    text = re.sub(r"<(\S(?:[^<>=]*?\S)?)>", r"(: \1 :)", text)
    text = re.sub(r"\b(\d+)e([+-]?\d+)\b", lambda m: ("" if m[1] == "1" else m[1] + "*") + f"10^({m[2]})", text)
    text = fractions(text)
    quoted = re.sub(r"([_^])(-?[A-Za-z0-9]+)", script, text)
    quoted = re.sub(r"\b([A-Za-z])(\d)\b", r"\1_\2", quoted)
    parts = re.split(r'("[^"]*")', quoted)
    parts = [part if index % 2 else re.sub(r"[A-Za-z]+", word, part) for index, part in enumerate(parts)]
    return re.sub(r'" \\ *\\ "', " ", "".join(parts))


def set_inline(text):
    """Mathematics in running text: exponents, subscripts, signs and Greek letters."""
    text = re.sub(r"(?<![\w.])([A-Za-z]'?)\.(?=[A-Za-z](?![\w.]|$)|[A-Za-z]_)", r"\1·", text)
    text = re.sub(r"(?<=[\w)|])\^\(([^()]*)\)", r"<sup>\1</sup>", text)
    text = re.sub(r"(?<=[\w)|'])\^(-?\w+(?:/\d+)?)", r"<sup>\1</sup>", text)
    text = re.sub(r"\b([A-Za-z]|" + "|".join(GREEK) + r")_([A-Za-z0-9]{1,5})\b", r"\1<sub>\2</sub>", text)
    text = re.sub(r"(?<=[)|])_(\w)\b", r"<sub>\1</sub>", text)
    text = text.replace("<=>", "⇔").replace("<=", "≤").replace(">=", "≥").replace("sqrt(", "√(").replace("[]", "∎")
    return re.sub(r"\b(" + "|".join(GREEK) + r")(?=\b|<)(?!-)", lambda match: GREEK[match[1]], text)
