#!/usr/bin/env python3
"""The checks of documents find what they are for, and leave right documents alone."""
import os
import tempfile
import unittest

import changelog
import identifiers
import links
import names
import readme
import sentences
import theory

CODE = "cmake_minimum_required(VERSION 3.25)\nproject(toy VERSION 0.2.0)\n"


def tree(**documents):
    """A folder with these files (`__` stands for /, `_md` for .md), to be cleaned up by the caller."""
    folder = tempfile.TemporaryDirectory()
    given = {"CMakeLists.txt": CODE, "fluid/pfem/solve.cpp": "void find_motion();\nstruct StepResult { int old_rate; };\n// --refine\n"}
    given |= {name.replace("__", "/").replace("_md", ".md"): text for name, text in documents.items()}
    for name, text in given.items():
        path = os.path.join(folder.name, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    return folder


def found(check, **documents):
    with tree(**documents) as root:
        return list(check(root))


class Links(unittest.TestCase):
    def test_lead_to_files_headings_and_anchors(self):
        good = "# A\n\n## Two *words*\n\n<a id=\"x\"></a>[a](b.md#here-now) [b](#two-words) [c](#x) `[d](gone.md)` [e](https://e.org)\n"
        self.assertEqual(found(links.faults, docs__a_md=good, docs__b_md="# Here, now\n"), [])

    def test_that_lead_nowhere_are_found(self):
        for link in ("gone.md", "b.md#gone", "#gone", "../gone.md"):
            with self.subTest(link):
                self.assertEqual(len(found(links.faults, docs__a_md=f"# A\n\n[a]({link})\n", docs__b_md="# B\n")), 1)


class Changelog(unittest.TestCase):
    HEAD = "# Changelog\n\nText.\n\n## 0.2.0 (unreleased)\n\n"

    def faults(self, body):
        return found(changelog.faults, CHANGELOG_md=self.HEAD + body)

    def test_of_releases_is_right(self):
        self.assertEqual(self.faults("### Added\n\n- One.\n\n### Fixed\n\n- Two\n  lines.\n\n## 0.1.0\n\n### Added\n\n- All.\n"), [])

    def test_faults_are_found(self):
        for body in ("### Removed\n\n- One.\n", "### Fixed\n\n- A.\n\n### Added\n\n- B.\n", "### Added\n\n- " + "word " * 26 + "\n",
                     "- One.\n", "### Added\n\nProse.\n", "### Changed\n\n- A breaking change.\n", "### Added\n\n- A.\n\n## 0.3.0\n"):
            with self.subTest(body):
                self.assertEqual(len(self.faults(body)), 1)


class Theory(unittest.TestCase):
    GOOD = "# T\n\n## One\n\nWith $`a_i`$:\n```math\nx=a_i \\tag{1}\n```\nSo. Code: `fluid/pfem/solve.cpp`:\n`find_motion`.\n\n## Symbols\n"

    def faults(self, old="", new=""):
        return found(theory.faults, docs__theory_md=self.GOOD.replace(old, new) if old else self.GOOD)

    def test_is_right(self):
        self.assertEqual(self.faults(), [])

    def test_faults_are_found(self):
        for old, new in (("find_motion", "find_notion"), ("solve.cpp", "sole.cpp"), ("So. Code:", "So.\n\n## Two\n\nCode:"), ("x=a_i", "x={a_i"),
                         ("x=a_i", "x=abla a_i"), ("$`a_i`$", "$a_i$"), ("tag{1}", "tag{2}"), ("So.", "See equation (2)."),
                         ("# T\n", "# T\n" + "\n" * 450)):
            with self.subTest(new):
                self.assertEqual(len(self.faults(old, new)), 1)

    def test_symbols_have_one_meaning_and_are_used(self):
        table = "\n| symbol | meaning |\n|---|---|\n| $`a_i`$ | one |\n"
        self.assertEqual(self.faults("## Symbols\n", "## Symbols\n" + table), [])
        for row in ("| $`a_i`$ | two |\n", "| $`q`$ | unused |\n"):
            self.assertEqual(len(self.faults("## Symbols\n", "## Symbols\n" + table + row)), 1)


class Mathematics(unittest.TestCase):
    def faults(self, text):
        return found(theory.mathematics_faults, docs__a_md="# A\n\n" + text)

    def test_is_right(self):
        self.assertEqual(self.faults("$`\\nabla p`$, $\\tfrac{1}{2}$, `${x`\n\n| $`\\lvert x\\rvert`$ |\n\n```math\n\\mathbf{x}\n```\n"), [])

    def test_faults_are_found(self):
        for text in ("$`\\tfrac{1`$\n", "$\\int N_i\nabla\\phi$\n", "| $`|x|`$ |\n", "```math\n\\begin{gathered}x\n```\n", "$`frac{1}{2}`$\n"):
            with self.subTest(text):
                self.assertEqual(len(self.faults(text)), 1)


class Glossary(unittest.TestCase):
    def faults(self, rows):
        return found(theory.glossary_faults, docs__glossary_md="# G\n\n| word | meaning |\n|---|---|\n" + rows)

    def test_rows_are_right(self):
        self.assertEqual(self.faults("| wave, crest | of water |\n| `find_motion` | finds |\n"), [])

    def test_faults_are_found(self):
        for rows in ("| wave | one |\n| crest, wave | two |\n", "| `find_notion` | is gone |\n", ""):
            with self.subTest(rows):
                self.assertEqual(len(self.faults(rows)), 1)


class Identifiers(unittest.TestCase):
    def faults(self, span):
        return found(identifiers.faults, docs__a_md=f"# A\n\nText with `{span}`.\n")

    def test_that_exist_are_left_alone(self):
        for span in ("fluid/pfem/solve.cpp", "solve.cpp", "fluid/pfem/solve.*", "fluid/", "find_motion", "find_motion(x)", "StepResult::old_rate",
                     "--refine", "word", "out/run/x_y.csv", "splashdown run fluid/pfem/solve.cpp --refine 2", "old_rate.1"):
            with self.subTest(span):
                self.assertEqual(self.faults(span), [])

    def test_that_are_gone_are_found(self):
        for span in ("fluid/gone.cpp", "gone.cpp", "fluid/gone.*", "fluid/gone/x.hpp", "find_notion", "lost(x)", "StepResult::new_rate",
                     "GoneType", "--gone", "fluid.size.gone", "splashdown run fluid/gone.toml", "splashdown run x --gone",
                     "splashdown run x --set old_rate.gone=1"):
            with self.subTest(span):
                self.assertEqual(len(self.faults(span)), 1)


class Names(unittest.TestCase):
    def faults(self, one, two):
        return found(names.faults, **{"fluid/one.hpp": one, "rigid/two.hpp": two, "apps/three.hpp": one})

    def test_with_one_meaning_are_left_alone(self):
        self.assertEqual(self.faults("struct Wave {\n  int a;\n};\nint height(int a);\n", "struct Load {};\nusing core::Wave;\n"), [])

    def test_of_two_headers_are_found(self):
        for text in ("struct Wave {\n};\n", "template <int d>\ndouble height(const Wave& wave);\n", "enum class Kind { a, b };\n"):
            with self.subTest(text):
                self.assertEqual(len(self.faults(text, text)), 1)


class Readmes(unittest.TestCase):
    GOOD = ("# A\n\nDoes it float?\n\n## Set-up\n\nA.\n\n## Run\n\n    splashdown run x\n\n## What you should see\n\n![c](p.png)\n\n"
            "## Agreement\n\n| what | bar |\n|---|---|\n| x | 1 % |\n\n## Cost\n\n3 s.\n\n## Reference\n\nB.\n")

    def faults(self, old="", new="", files=("scene.toml", "check.toml")):
        return list(readme.faults_of("a", readme.Readme(self.GOOD.replace(old, new) if old else self.GOOD), files))

    def test_of_the_pattern_are_right(self):
        self.assertEqual(self.faults(), [])
        self.assertEqual(self.faults("![c](p.png)", "Lines.", files=("main.cpp",)), [])

    def test_faults_are_found(self):
        for old, new in (("# A\n", "# A\n\n# B\n"), ("float?", "float."), ("## Cost", "## Price"), ("## Reference", "## Sources"),
                         ("## Reference\n", "## Reference\n\n## Limits\n"), ("    splashdown", "splashdown"), ("![c](p.png)", "None."),
                         ("![c](p.png)", "![c](p.png) ![c](q.png)"), ("| what | bar |\n|---|---|\n| x | 1 % |", "Good."), ("3 s.", "Little.")):
            with self.subTest(new):
                self.assertEqual(len(self.faults(old, new)), 1)


    def test_bars_are_those_of_the_check(self):
        table = "| what | bar |\n|---|---|\n| x | 1.5 %, below 3 % |\n"
        other = "\n| | a | b |\n|---|---|---|\n| value | 7 % | |\n| bar of it | 2 % | 0.5 % |\n"
        good = readme.Readme(self.GOOD.replace("| what | bar |\n|---|---|\n| x | 1 % |\n", table + other))
        self.assertEqual(list(good.bars()), ["1.5", "3", "2", "0.5"])
        check = "[[check]]\ntolerance = 0.015\nat_most = 0.0299\n[[check]]\nexpected = 'x'\nat_least = -0.02\n"
        self.assertEqual(readme.bars_of(check), {"1.5", "3", "2"})


class Sentences(unittest.TestCase):
    def test_are_counted_in_words(self):
        thirty = " ".join(["word"] * 30)
        self.assertEqual(list(sentences.long_sentences(f"Word {thirty[5:]}. Word {thirty[5:]}.\n", 30)), [])
        self.assertEqual([n for n, _, _ in sentences.long_sentences(f"# T\n\nShort. {thirty}\nword. Short.\n", 30)], [3])

    def test_end_behind_words_that_end_like_abbreviations(self):
        self.assertEqual([w for _, w, _ in sentences.long_sentences("It is vertical. It falls. Lamb et al. Show it.", 0)], [3, 2, 5])

    def test_code_and_links_count_as_read(self):
        line = "A [link of four words](a.md#b) and `some code here` and $`x + y`$."
        self.assertEqual([w for _, w, _ in sentences.long_sentences(line, 1)], [9])

    def test_code_blocks_are_none(self):
        block = "```\n" + "word " * 40 + "\n```\n\n    " + "word " * 40 + "\n"
        self.assertEqual(list(sentences.long_sentences(block, 30)), [])


if __name__ == "__main__":
    unittest.main()
