#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/site makes of pages and headers, without Doxygen, and the links of all pages.

Usage: site_test.py ROOT
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "docs" / "site"))
import formulas  # noqa: E402
import links  # noqa: E402
import pages  # noqa: E402


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def test_every_link_of_the_repositorys_pages_leads_to_a_heading(self):
        written = [page.read_text(encoding="utf-8") for page in pages.write_pages(ROOT, self.path / "pages")]
        anchors = [name for text in written for name in re.findall(r"\{#([\w-]+)\}", text)]
        wanted = {name for text in written for name in re.findall(r"@(?:sub)?(?:ref|page) ([\w-]+)", text)}
        self.assertGreater(len(wanted), 50)
        self.assertEqual(sorted(wanted - set(anchors)), [])
        self.assertEqual(sorted(anchors), sorted(set(anchors)))

    def test_a_link_to_a_file_that_is_not_there_is_refused(self):
        (self.path / "docs").mkdir()
        (self.path / "README.md").write_text("# One\n\nSee [two](docs/two.md).\n", encoding="utf-8")
        with self.assertRaisesRegex(SystemExit, r"README.md: the link \(docs/two.md\) leads to nothing"):
            pages.write_pages(self.path, self.path / "pages")

    def test_headings_have_the_anchors_that_github_gives_them(self):
        self.assertEqual(pages.slug("Which answers are global?"), "which-answers-are-global")
        self.assertEqual(pages.slug("The `gap` of [A](a.md), B"), "the-gap-of-a-b")


class Links(unittest.TestCase):
    def test_files_and_anchors_that_are_not_there_are_named(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "a.html").write_text('<a href="b.html#here">1</a><a href="b.html#gone">2</a>\n<img src="no.png">'
                                           '<a href="../out.html">3</a><a href="https://example.org/">4</a>', encoding="utf-8")
            (folder / "b.html").write_text('<h1 id="here">B</h1>', encoding="utf-8")
            dead, count = links.dead_links(folder)
        self.assertEqual(count, 4)
        self.assertEqual(dead, ["a.html:1: b.html#gone: no such anchor", "a.html:2: no.png: no such file",
                                "a.html:2: ../out.html: leads out of the site"])


class Formulas(unittest.TestCase):
    def test_products_are_no_signs_and_words_are_text(self):
        self.assertEqual(formulas.set_formula("    a:nn <= max x_A"), "a:n n <=  max  x_A")
        self.assertIn('"at most"', formulas.set_formula("    h + at most 5.5u"))

    def test_a_slash_becomes_a_fraction_only_where_both_sides_are_plain(self):
        self.assertEqual(formulas.set_formula("    (J_A / h_A^3 + 1)"), "(J_A/h_A^3 + 1)")
        self.assertEqual(formulas.set_formula("    (1/4 pi)").replace(" ", ""), "(1//4pi)")
        self.assertEqual(formulas.set_formula("    m' J m / h^3 = 0"), "m' J m // h^3 = 0")

    def test_commands_are_no_formulas(self):
        self.assertFalse(formulas.is_formula(["    build/dev/bench/bench_trace"]))
        self.assertTrue(formulas.is_formula(["    f'' + f = -P(t)"]))

    def test_running_text_has_exponents_and_indices(self):
        self.assertEqual(formulas.set_inline("x_A <= 2^-53 rho"), "x<sub>A</sub> ≤ 2<sup>-53</sup> ρ")


class Headers(unittest.TestCase):
    def filtered(self, text):
        with tempfile.NamedTemporaryFile("w", suffix=".hpp") as header:
            header.write(text)
            header.flush()
            return subprocess.run([sys.executable, "-B", ROOT / "docs" / "site" / "header_filter.py", header.name],
                                  check=True, text=True, stdout=subprocess.PIPE).stdout

    def test_lines_stay_lines(self):
        for header in (ROOT / "geometry" / "gap.hpp", ROOT / "dem" / "observe.hpp"):
            text = header.read_text(encoding="utf-8")
            self.assertEqual(self.filtered(text).count("\n"), text.count("\n"))

    def test_every_name_of_a_declaration_has_its_text(self):
        self.assertEqual(self.filtered("double a, b = f(1, 2);  ///< length < 1"),
                         "double a; /**< length \\< 1 */ double b = f(1, 2); /**< length \\< 1 */")
        self.assertEqual(self.filtered("/// Means <nn>.\ndouble a, b;"),
                         "/// Means \\<nn\\>.\ndouble a; /** Means \\<nn\\>. */ double b;")

    def test_inline_namespaces_are_read(self):
        self.assertEqual(self.filtered("namespace tangency::inline v0::dem {"), "namespace tangency::dem {")


unittest.main()
