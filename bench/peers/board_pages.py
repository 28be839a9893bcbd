# SPDX-License-Identifier: GPL-3.0-or-later
"""The board as Markdown and as a page of its own: one table of all codes, then one a corpus."""
import html
import re
import sys

COUNT, ERROR, TEXT = "count", "error", "text"
SUMMARY = ("code", "definition", "grade", "wrong", "touches", "no answer", "without a gap",
           "largest gap error / L", "reversed", "largest normal error")
CORPUS = ("code", "wrong", "touches", "failed / ended / hung", "without a gap", "gap error, median",
          "99 %", "largest", "reversed", "normal error, median", "99 %")
COUNTS = ("wrong relations", "overlaps on an external touch")


def count(value):
    return "-" if value is None else str(int(value))


def error(value):
    if value is None:
        return "-"
    if value >= sys.float_info.max:
        return "inf"
    return "0" if value == 0 else f"{value:.1e}"


def definition(code):
    """None where a code gives no gap: it says yes or no alone."""
    return code.definition if code.total("rows without a gap") is not None else "-"


def summary_row(code):
    return (code.name, definition(code), code.letter, *(count(code.total(c)) for c in COUNTS),
            count(code.total("rows without an answer")), count(code.total("rows without a gap")),
            error(code.largest("gap error, largest")), count(code.total("reversed normals")),
            error(code.largest("normal error, largest")))


def corpus_row(code, corpus):
    v = code.values[corpus]
    return (code.name, *(count(v.get(c)) for c in COUNTS), code.ended[corpus],
            count(v.get("rows without a gap")),
            *(error(v.get(f"gap error, {which}")) for which in ("median", "99 %", "largest")),
            count(v.get("reversed normals")),
            *(error(v.get(f"normal error, {which}")) for which in ("median", "99 %")))


def tables(codes, corpora):
    """(heading, header, rows) of each table."""
    pairs = {c: int(codes[0].values[c]["pairs"]) for c in corpora}
    yield f"All corpora, {sum(pairs.values())} pairs", SUMMARY, [summary_row(c) for c in codes]
    for corpus in corpora:
        yield (f"{corpus}, {pairs[corpus]} pairs", CORPUS,
               [corpus_row(c, corpus) for c in codes])


def first_number(header):
    """The columns before it are words."""
    return 3 if header is SUMMARY else 1


def markdown_tables(codes, corpora):
    text = []
    for heading, header, rows in tables(codes, corpora):
        words = first_number(header)
        text += [f"### {heading}", "", "| " + " | ".join(header) + " |",
                 "|" + "---|" * words + "---:|" * (len(header) - words)]
        text += ["| " + " | ".join(row) + " |" for row in rows] + [""]
    return "\n".join(text)


STYLE = """
:root { color-scheme: light dark; --line: #8886; --back: #fff; --head: #eee; }
@media (prefers-color-scheme: dark) { :root { --back: #181818; --head: #2a2a2a; } }
body { font: 15px/1.5 system-ui, sans-serif; margin: 0 auto; padding: 1rem; max-width: 76rem;
       background: var(--back); }
h1 { font-size: 1.4rem; } h2 { font-size: 1.1rem; margin-top: 2rem; }
.wide { overflow-x: auto; border: 1px solid var(--line); }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: .3rem .6rem; border-bottom: 1px solid var(--line); text-align: right;
         white-space: nowrap; }
th { background: var(--head); white-space: normal; }
td:first-child, th:first-child { text-align: left; white-space: normal; min-width: 9rem;
  max-width: 24rem; overflow-wrap: anywhere; position: sticky; left: 0; background: var(--back); }
th:first-child { background: var(--head); }
.word { text-align: left; }
code { font-size: .9em; }
"""


def cell(text):
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(text))


def html_page(codes, corpora, version):
    parts = []
    for heading, header, rows in tables(codes, corpora):
        words = first_number(header)
        kinds = [" class=word" if i < words else "" for i in range(len(header))]
        head = "".join(f"<th scope=col{k}>{html.escape(h)}</th>" for k, h in zip(kinds, header))
        body = "".join(
            "<tr>" + "".join(f"<td{k}>{cell(text)}</td>" for k, text in zip(kinds, row)) + "</tr>\n"
            for row in rows)
        parts.append(f"<h2>{html.escape(heading)}</h2>\n<div class=wide tabindex=0><table><thead>"
                     f"<tr>{head}</tr></thead><tbody>\n{body}</tbody></table></div>\n")
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Contact codes, graded</title><style>{STYLE}</style></head><body>
<h1>Contact codes, graded</h1>
<p>Each code is held to its own definition of depth by {html.escape(version)}. Errors of gaps are in
L, the distance of the centres and both largest semi-axes. Grades and columns are those of the page
docs/grading.md; a row without an answer counts as a wrong one for the grade.</p>
{"".join(parts)}</body></html>
"""
