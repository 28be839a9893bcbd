# SPDX-License-Identifier: MIT
"""Text of a scene of tangency-dem (TOML) from plain values.

A body is what all stages share: {"cell": {...}, "motion": {...}, "particles": {NAME: {...}},
"contact": {...}} and, if so wanted, "intended": [...]. A stage is its keys. The order of the keys is
that in which they were given, so that one body and one list of stages have one text.
"""


def value_text(value):
    """A value as TOML has it: numbers read back to the same double."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return "[" + ", ".join(map(value_text, value)) + "]"


def table_text(header, keys):
    return "".join([header, "\n", *(f"{key} = {value_text(keys[key])}\n" for key in keys), "\n"])


def scene_text(body, stages, output):
    """@param output  keys of [output]"""
    parts = ["schema = 1\n"]
    if body.get("intended"):
        parts.append(f"intended = {value_text(body['intended'])}\n")
    parts.append("\n")
    for section in ("cell", "motion"):
        if body.get(section):
            parts.append(table_text(f"[{section}]", body[section]))
    for name, keys in body["particles"].items():
        parts.append(table_text(f"[particles.{name}]", keys))
    parts.append(table_text("[contact]", body["contact"]))
    parts.extend(table_text("[[stage]]", stage) for stage in stages)
    parts.append(table_text("[output]", output))
    return "".join(parts).rstrip("\n") + "\n"
