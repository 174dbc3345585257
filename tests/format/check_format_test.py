"""The checker finds what it is for."""

import shutil
import tempfile
import unittest
from pathlib import Path

from check_format import unformatted

CLANG_FORMAT = shutil.which("clang-format-14") or shutil.which("clang-format")


@unittest.skipUnless(CLANG_FORMAT, "no clang-format")
class CheckFormat(unittest.TestCase):
    def test_only_the_bad_file_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            good, bad = Path(folder, "good.h"), Path(folder, "bad.h")
            good.write_text("int a;\n")
            bad.write_text("int   a ;\n")
            self.assertEqual(unformatted(CLANG_FORMAT, [good, bad]), [str(bad)])


if __name__ == "__main__":
    unittest.main()
