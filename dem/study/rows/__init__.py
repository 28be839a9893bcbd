# SPDX-License-Identifier: MIT
"""The rows of the study, one file a section, in their order."""
import importlib

SECTIONS = ("table_5_2", "growth", "shear", "contacts", "anisotropies", "stress_force_fabric",
            "contact_statistics")


def all_rows():
    found = []
    for name in SECTIONS:
        try:
            found += importlib.import_module(f"rows.{name}").rows.rows
        except ModuleNotFoundError as missing:
            if missing.name != f"rows.{name}":
                raise
    return found
