"""`froxel diff` from outside: figures, exit codes, and every file that it writes.

FROXEL_BINARY is its path.
"""

import json
import os
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

FROXEL = os.environ["FROXEL_BINARY"]
TEMPLATE = '<html><script type="application/json" id="results">null</script></html>'


def froxel(*arguments):
    return subprocess.run([FROXEL, "diff", *map(str, arguments)], capture_output=True, text=True,
                          timeout=120, check=False)


def write_pfm(path, values, width=4, height=4):
    """One grey value, or those by pixel from the lowest row on."""
    path.parent.mkdir(parents=True, exist_ok=True)
    listed = values if isinstance(values, list) else [values] * (width * height)
    path.write_bytes(f"Pf\n{width} {height}\n-1.0\n".encode() + struct.pack(f"<{len(listed)}f", *listed))


class Diff(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)
        self.a = self.folder / "a.pfm"
        self.b = self.folder / "b.pfm"

    def test_equal_pictures_succeed(self):
        write_pfm(self.a, 0.5)
        write_pfm(self.b, 0.5)
        run = froxel(self.a, self.b)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "ok   a.pfm: equal, 16 pixels compared\n", ""))

    def test_a_difference_fails_unless_a_limit_allows_it(self):
        write_pfm(self.a, [0.5] * 15 + [0.75])
        write_pfm(self.b, 0.5)
        run = froxel(self.a, self.b)
        self.assertEqual(run.returncode, 1)
        self.assertIn("1 of 16 pixels differ, by at most 0.25; the first is (3, 0): 0.75 0.75 0.75 instead of 0.5",
                      run.stdout)
        self.assertTrue(run.stdout.startswith("FAIL a.pfm: "), run.stdout)
        self.assertEqual(froxel(self.a, self.b, "--max-differing", "0.07").returncode, 0)
        self.assertEqual(froxel(self.a, self.b, "--tolerance", "0.25").returncode, 0)
        self.assertEqual(froxel(self.a, self.b, "--max-rmse", "0.07").returncode, 0)
        self.assertEqual(froxel(self.a, self.b, "--max-flip", "0").returncode, 1)

    def test_folders_are_compared_by_name_and_every_file_is_written(self):
        one, two = self.folder / "one", self.folder / "two"
        for side, value in ((one, 0.5), (two, 0.25)):
            write_pfm(side / "same.pfm", 1.0)
            write_pfm(side / "deep/other.pfm", value)
        write_pfm(one / "new.pfm", 1.0)
        write_pfm(two / "size.pfm", 1.0)
        write_pfm(one / "size.pfm", 1.0, 2, 8)
        (one / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n")
        (two / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n")
        (self.folder / "diff.html").write_text(TEMPLATE)
        out, page, junit = (self.folder / name for name in ("heat", "page.html", "junit.xml"))
        run = froxel(one, two, "--out", out, "--json", "-", "--junit", junit, "--report", page, "--web-root",
                     self.folder)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("5 pairs of pictures: 1 equal, 4 failed", run.stderr)
        result = json.loads(run.stdout)
        self.assertEqual(result["schema"], "froxel.diff.v1")
        pairs = {pair["name"]: pair for pair in result["pairs"]}
        self.assertEqual({name for name, pair in pairs.items() if not pair["failed"]}, {"same.pfm"})
        self.assertEqual(pairs["deep/other.pfm"]["difference"]["rmse"], 0.25)
        self.assertIn("does not have it", pairs["new.pfm"]["faults"][0])
        self.assertIn("2x8 and 4x4", pairs["size.pfm"]["faults"][0])
        self.assertIn("is a broken PNG file", pairs["broken.png"]["faults"][0])
        self.assertEqual([str(file.relative_to(out)) for file in out.rglob("*.png")], ["deep/other.pfm.flip.png"])
        suite = xml.etree.ElementTree.parse(junit).find("testsuite")
        self.assertEqual((suite.get("name"), suite.get("tests"), suite.get("failures")), ("froxel diff", "5", "4"))
        shown = json.loads(page.read_text().split('id="results">')[1].split("</script>")[0])
        with_pictures = [pair for pair in shown["pairs"] if "pictures" in pair]
        self.assertEqual([pair["name"] for pair in with_pictures], ["deep/other.pfm"])
        for url in with_pictures[0]["pictures"].values():
            self.assertTrue(url.startswith("data:image/png;base64,iVBOR"), url[:40])

    def test_what_cannot_be_compared_is_one_line(self):
        write_pfm(self.a, 1.0)
        for arguments, code, words in (
                ((self.a, self.folder), 2, "is a file, "),
                ((self.a, self.folder / "absent.png"), 1, "it does not exist"),
                ((self.folder / "..", self.folder / "no folder"), 1, "it does not exist"),
                ((self.a,), 2, "B is required"),
                ((self.a, self.a, "--max-flip", "2"), 2, "--max-flip"),
                ((self.a, self.a, "--json", self.folder / "no/a.json"), 1, "there is no folder")):
            run = froxel(*arguments)
            self.assertEqual(run.returncode, code, run.stderr)
            self.assertIn(words, run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)


if __name__ == "__main__":
    unittest.main()
