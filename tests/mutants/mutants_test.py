#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators change what they say and nothing else; the draw and the bookkeeping add up."""
import argparse
import importlib.machinery
import importlib.util
import pathlib
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import fast_tests
from mutants import Explained, draws, mutants_of, plain, shares, sources
from operators import OPERATORS, changes
from planted import planted_in, read
from results import Results, share_killed, table
from tree import Tree

ROOT = pathlib.Path(__file__).resolve().parents[2]


def made(operator, statement):
    """What an operator makes of a statement in a function."""
    text = f"void f() {{\n  {statement}\n}}\n"
    found = [c.applied_to(text) for c in changes(text) if c.operator == operator]
    return [plain(t)[len("void f() { "):-len(" }")] for t in found]


class Operators(unittest.TestCase):
    def test_sign_turns_plus_and_minus(self):
        self.assertEqual(made("sign", "x = a + b;"), ["x = a - b;"])
        self.assertEqual(made("sign", "x -= a;"), ["x += a;"])
        self.assertEqual(made("sign", "return -a;"), ["return a;"])

    def test_index_takes_another_component(self):
        self.assertEqual(made("index", "x = a[2];"), ["x = a[0];", "x = a[1];"])
        self.assertEqual(made("index", "x = a[i];"), ["x = a[0];"])
        self.assertEqual(made("index", "x = v.z;"), ["x = v.x;"])
        self.assertEqual(made("index", "x = m.col(0);"), ["x = m.col(1);", "x = m.col(2);"])

    def test_index_leaves_sizes_and_lambdas(self):
        self.assertEqual(made("index", "double a[2];"), [])
        self.assertEqual(made("index", "const auto f = [x](int) { return x; };"), [])

    def test_comparison_moves_the_boundary_or_turns_it_round(self):
        self.assertEqual(made("comparison", "x = a < b;"), ["x = a <= b;", "x = a >= b;"])
        self.assertEqual(made("comparison", "x = a == b && !c;"),
                         ["x = a != b && !c;", "x = a == b || !c;", "x = a == b && c;"])

    def test_comparison_leaves_templates(self):
        self.assertEqual(made("comparison", "std::vector<int> v = f<1>(std::move(w));"), [])
        self.assertEqual([c for c in changes("template <class T>\nvoid f(T&& t);\n")], [])

    def test_constant_gives_a_neighbour_nothing_or_the_opposite(self):
        self.assertEqual(made("constant", "x = 3 * a;"),
                         ["x = (3 + 1) * a;", "x = (3 - 1) * a;", "x = 0 * a;"])
        self.assertEqual(made("constant", "x = 0.5;"),
                         ["x = (-0.5);", "x = (0.5 + 1.0);", "x = (0.5 - 1.0);", "x = 0.0;"])
        self.assertEqual(made("constant", "x = 0x1p60;"), ["x = (-0x1p60);", "x = 0.0;"])

    def test_dropped_statement_takes_it_whole_and_keeps_the_lines(self):
        self.assertEqual(made("dropped statement", "x = a;"), [";"])
        self.assertEqual(made("dropped statement", "if (a) return b;"), [";"])
        self.assertEqual(made("dropped statement", "f(a, [&] { return b; });"), [";"])
        text = "void f() {\n  g(a,\n    b);\n}\n"
        for change in changes(text):
            self.assertEqual(change.applied_to(text).count("\n"), text.count("\n"))

    def test_dropped_statement_leaves_declarations_answers_and_assertions(self):
        for statement in ("const double x = a;", "Vec3 v(a, b);", "return a;", "assert(f(a));",
                          "std::vector<int> v(n);", "using A = B;", "double* p = f();"):
            self.assertEqual(made("dropped statement", statement), [], statement)
        self.assertEqual(made("dropped statement", "if (a) return b; else return c;"), [])

    def test_swapped_argument_exchanges_neighbours(self):
        self.assertEqual(made("swapped argument", "f(a, b, g(c));"),
                         ["f(b, a, g(c));", "f(a, g(c), b);"])
        self.assertEqual(made("swapped argument", "return {a, b};"), ["return {b, a};"])
        self.assertEqual(made("swapped argument", "x = std::max(a, b);"), [])
        self.assertEqual(made("swapped argument", "f(a, a);"), [])

    def test_comments_strings_directives_and_assertions_stay(self):
        for statement in ("// a + b < 3", "/* -1 */", '#define A (1 + 2)', 'f("a + 1");',
                          "static_assert(a + 1 < 2);", "assert(a[0] == -1);"):
            text = f"void f() {{\n{statement}\n}}\n"
            self.assertEqual([c for c in changes(text) if c.operator != "dropped statement"], [],
                             statement)

    def test_every_change_of_the_kernel_changes_its_text_within_its_lines(self):
        seen = set()
        for file, text in sources(ROOT, r"geometry/(gap|normals)/|two_lanes").items():
            for mutant in mutants_of(file, text):
                self.assertNotEqual(plain(mutant.original), plain(mutant.mutated), mutant.diff())
                self.assertEqual(mutant.change.applied_to(text).count("\n"), text.count("\n"))
                self.assertNotIn(mutant.id, seen)
                seen.add(mutant.id)
        self.assertGreater(len(seen), 1000)


class Draw(unittest.TestCase):
    TEXT = "int f(int a) {\n  a += 1;\n  return a * 2;\n}\n"

    def test_every_file_has_a_share_and_they_add_up(self):
        self.assertEqual(shares({"a": 1, "b": 99, "c": 100}, 20), {"a": 1, "b": 9, "c": 10})
        self.assertEqual(shares({"a": 1, "b": 1000}, 2), {"a": 1, "b": 1})

    def test_a_seed_draws_the_same_and_each_mutant_once(self):
        mutants = mutants_of("geometry/f.cpp", self.TEXT)
        first = [m.id for m in draws(1, "geometry/f.cpp", mutants)]
        self.assertEqual(first, [m.id for m in draws(1, "geometry/f.cpp", mutants)])
        self.assertEqual(sorted(first), sorted(m.id for m in mutants))

    def test_the_first_draws_are_of_different_lines(self):
        mutants = mutants_of("geometry/f.cpp", self.TEXT)
        one, other = [m for _, m in zip(range(2), draws(1, "geometry/f.cpp", mutants))]
        self.assertNotEqual(one.change.line, other.change.line)

    def test_ids_outlive_edits_elsewhere(self):
        before = {m.id for m in mutants_of("geometry/f.cpp", self.TEXT)}
        after = {m.id for m in mutants_of("geometry/f.cpp", "int g();\n" + self.TEXT)}
        self.assertEqual(before, after)


class Bookkeeping(unittest.TestCase):
    EXPLAINED = ("## Equivalent\n\n### geometry/f.cpp\n```diff\n-  return a * 2;\n"
                 "+  return a * (2 + 1);\n```\nSome reason.\n\n## Not noticed\n")

    def test_an_explanation_is_found_by_text_and_a_stale_one_is_told(self):
        explained = Explained(self.EXPLAINED)
        mutants = mutants_of("geometry/f.cpp", "\n" + Draw.TEXT)
        self.assertEqual([explained.of(m) for m in mutants if explained.of(m)],
                         [("equivalent", "Some reason.")])
        self.assertEqual(explained.stale({"geometry/f.cpp": Draw.TEXT}), [])
        self.assertEqual(len(explained.stale({"geometry/f.cpp": "int f(int a);\n"})), 1)

    def test_an_explanation_needs_a_reason(self):
        with self.assertRaises(ValueError):
            Explained(self.EXPLAINED.replace("Some reason.", ""))

    def test_equivalents_and_what_does_not_compile_are_not_in_the_share(self):
        rows = [{"status": s, "operator": "sign"} for s in
                ("killed", "killed", "killed", "survived", "equivalent", "not compiling")]
        self.assertEqual(share_killed(rows), 0.75)
        self.assertIn("| sign | 5 | 3 | 1 | 1 | 1 | 75.0 % |",
                      list(table(rows, "operator", OPERATORS)))

    def test_a_resumed_run_keeps_what_still_holds(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "results.jsonl")
            settings = {"tree": "1", "slowest": 1.0, "texts": {"f": "t", "g": "t"}}
            first = Results(path, settings, resume=False)
            for name, status, file in (("k", "killed", "f"), ("s", "survived", "f"),
                                       ("o", "killed", "g")):
                first.add({"id": name, "status": status, "file": file, "tree": "1",
                           "slowest": 1.0, "text": "t"})
            with path.open("a") as out:
                out.write('{"id": "torn')
            self.assertEqual(set(Results(path, settings, True).rows), {"k", "s", "o"})
            other = {**settings, "tree": "2"}
            self.assertEqual(set(Results(path, other, True, {"s"}).rows), {"k", "s", "o"})
            changed = {**settings, "tree": "2", "texts": {"f": "t", "g": "new"}}
            self.assertEqual(set(Results(path, changed, True).rows), {"k"})
            first.add({"id": "s", "status": "survived", "file": "f", "tree": "1", "slowest": 1.0,
                       "text": "t"})
            self.assertEqual(set(Results(path, {**settings, "slowest": 2.0}, True).rows), {"k"})
            self.assertEqual(Results(path, settings, resume=False).rows, {})

    def test_a_mutant_is_taken_out_again(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = Tree(ROOT, pathlib.Path(folder), 1)
            source, built = tree.source / "geometry/f.cpp", tree.build / "f.o"
            for path in (source, built):
                path.parent.mkdir(parents=True)
                path.write_text(Draw.TEXT)
            tree._keep_build()
            was = source.stat().st_mtime_ns, built.stat().st_mtime_ns
            mutant = mutants_of("geometry/f.cpp", Draw.TEXT)[0]
            tree.put(mutant)
            built.write_text("mutated")
            self.assertFalse(tree.is_clean(["f.o"]))
            self.assertNotEqual(source.read_text(), Draw.TEXT)
            tree.take_out()
            self.assertTrue(tree.is_clean(["f.o"]))
            self.assertEqual(source.read_text(), Draw.TEXT)
            self.assertEqual((source.stat().st_mtime_ns, built.stat().st_mtime_ns), was)


class Reach(unittest.TestCase):
    def test_every_source_of_the_library_reaches_a_test(self):
        # But for version.cpp, whose header CMake makes.
        for file in sources(ROOT, r"^geometry/(?!tool/|tables/|version\.cpp).*\.cpp"):
            away = fast_tests.distances(ROOT, file)
            self.assertTrue(any(room.startswith("tests/") for room in away), file)

    def test_a_source_reaches_what_uses_the_header_of_its_folder(self):
        away = fast_tests.distances(ROOT, "geometry/gap/search_coaxial.cpp")
        self.assertEqual(away["geometry/gap"], 2)
        self.assertEqual(away["tests/geometry/gap_test"], 3)
        self.assertNotIn("tests/geometry/polynomial_test", away)


class Children(unittest.TestCase):
    def outcome(self, script, clean=0.0):
        return fast_tests.FastTests._run(None, ["sh", "-c", script], clean)

    def test_an_exit_status_or_a_signal_is_a_kill_and_named(self):
        self.assertTrue(self.outcome("exit 0").passed)
        self.assertEqual(self.outcome("exit 3").by, "exit status 3")
        self.assertEqual(self.outcome("kill -SEGV $$").by, "SIGSEGV")
        failing = 'echo "[  FAILED  ] Gap.IsRight (3 ms)"; exit 1'
        self.assertEqual(self.outcome(failing).by, "Gap.IsRight")

    def test_what_does_not_end_is_ended_by_its_cpu_time(self):
        slack, fast_tests.SLACK = fast_tests.SLACK, 0.0
        try:
            self.assertEqual(self.outcome("while :; do :; done").by, "does not end")
        finally:
            fast_tests.SLACK = slack

    def test_what_stands_still_is_ended(self):
        idle, look = fast_tests.IDLE, fast_tests.LOOK
        fast_tests.IDLE, fast_tests.LOOK = 0.2, 0.1
        try:
            self.assertEqual(self.outcome("mkfifo never; read line < never").by, "stands still")
        finally:
            fast_tests.IDLE, fast_tests.LOOK = idle, look


class PlantedMutants(unittest.TestCase):
    def test_each_stands_once_in_its_file_and_says_what_is_wrong(self):
        mutants = read(ROOT / "tests/mutants/hunted.md")
        self.assertGreaterEqual(len(mutants), 6)
        for mutant in mutants:
            text = (ROOT / mutant.file).read_text()
            self.assertNotEqual(mutant.applied_to(text), text)
            self.assertTrue(mutant.reason)

    def test_lines_that_are_not_there_are_refused(self):
        mutant, = planted_in("### geometry/a.cpp\n```diff\n-  x = 1;\n+  x = 2;\n```\nWrong.\n")
        self.assertEqual(mutant.applied_to("{\n  x = 1;\n}\n"), "{\n  x = 2;\n}\n")
        for text in ("{\n  y = 1;\n}\n", "  x = 1;\n  x = 1;\n"):
            with self.assertRaisesRegex(ValueError, "geometry/a.cpp: these lines are not there once"):
                mutant.applied_to(text)


class Hunted(unittest.TestCase):
    """What a hunt says of a mutant, by a program that prints and ends as it is told."""

    PRINTED = ("finding 1: bound broken (long), from near, answer 7\n  a  centre 0\n  b  centre 1\n"
               "  true: separate, gap 0.25; answered: overlaps 1\n")

    def asked(self, last, printed=""):
        loader = importlib.machinery.SourceFileLoader("hunted", str(ROOT / "tests/mutants/hunted"))
        hunted = importlib.util.module_from_spec(importlib.util.spec_from_loader("hunted", loader))
        loader.exec_module(hunted)
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "tests/verify/kernel_hunt")
            program.parent.mkdir(parents=True)
            pathlib.Path(folder, "said").write_text(printed)
            program.write_text(f"#!/bin/sh\ncat '{folder}/said'\n{last}\n")
            program.chmod(0o755)
            return hunted.hunt(types.SimpleNamespace(build=pathlib.Path(folder)), "single",
                               argparse.Namespace(answers=1, seed=1))

    def test_a_finding_is_read_and_a_hunt_without_one_found_nothing(self):
        self.assertEqual(self.asked("exit 1", self.PRINTED),
                         ("bound broken", 7, "  a  centre 0\n  b  centre 1\n",
                          "separate, gap 0.25; answered: overlaps 1"))
        self.assertIsNone(self.asked("exit 0"))

    def test_a_program_that_crashes_has_found_the_mutant(self):
        self.assertEqual(self.asked("kill -SEGV $$")[0], "it ended")

    def test_a_hunt_that_is_refused_has_found_nothing(self):
        with self.assertRaisesRegex(Exception, "kernel_hunt: status 2: no such call"):
            self.asked("echo no such call >&2; exit 2")


if __name__ == "__main__":
    unittest.main()
