# SPDX-License-Identifier: MIT
"""The rows of the study, one file a section, in their order."""
import importlib

SECTIONS = ("table_5_2", "growth", "shear", "contacts", "anisotropies", "stress_force_fabric",
            "shares", "signs", "contact_statistics")


def all_rows():
    return [row for name in SECTIONS for row in importlib.import_module(f"rows.{name}").rows.rows]
