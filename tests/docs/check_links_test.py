"""The checker finds what it is for."""

import tempfile
import unittest
from pathlib import Path

from check_links import anchors, check_tree, links


class CheckLinks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()

    def violations(self, **texts):
        """Of a tree with these files; __ in a name is a slash, and .md follows unless it has a dot."""
        for name, text in texts.items():
            path = self.root / name.replace("__", "/").replace("_dot_", ".")
            path = path if path.suffix else path.with_suffix(".md")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return list(check_tree(self.root))

    def test_links_that_resolve_pass(self):
        self.assertEqual(self.violations(
            a="# A\n[b](docs/b.md#of-b) [up](#a) [far](https://example.org/x)",
            docs__b="## Of B\n![picture](../p.png) [folder](../docs)", p_dot_png=""), [])

    def test_missing_file_is_named_with_its_line(self):
        self.assertEqual(self.violations(a="\n\n[b](b.md)"), ["a.md:3: b.md is not there"])

    def test_link_over_two_lines_and_code_as_text(self):
        self.assertEqual(len(self.violations(a="[two\nlines](b.md) [`code`](c.md)")), 2)

    def test_missing_heading(self):
        found = self.violations(a="[b](b.md#none)", b="# Some\n```\n# none\n```\n")
        self.assertEqual(found, ["a.md:1: b.md#none: no heading of that name"])

    def test_links_in_code_are_none(self):
        self.assertEqual(links("`[a](b)`\n```\n[c](d)\n```\n[e](f)"), [(5, "f")])

    def test_anchors_are_those_of_github(self):
        self.assertEqual(anchors("# One picture: `froxel render`\n## Two\n## Two\n"),
                         {"one-picture-froxel-render", "two", "two-1"})

    def test_nothing_outside_the_tree(self):
        self.assertEqual(len(self.violations(a="[up](../..)")), 1)

    def test_page_that_the_index_lacks(self):
        found = self.violations(docs__README="[a](a.md)", docs__a="", docs__b="")
        self.assertEqual(found, ["docs/b.md: docs/README.md does not link it"])

    def test_document_that_a_comment_names(self):
        found = self.violations(a_dot_cpp="// see docs/a.md\n// and docs/b.md", docs__a="")
        self.assertEqual(found, ["a.cpp:2: docs/b.md is not there"])


if __name__ == "__main__":
    unittest.main()
