"""What deploy/summarize_tests.py counts."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "deploy/summarize_tests.py"
# As ctest writes it: two executables as a whole, and a test that is none.
CTEST = """<testsuite><testcase name="core_test" status="{core}">{core_failure}</testcase>
<testcase name="render_test" status="run"/><testcase name="hostile.work" status="run"/></testsuite>"""
GTEST = """<testsuites><testsuite name="Text"><testcase name="Long_IsCut" status="run" classname="Text"/>
<testcase name="Empty_Stays" status="run" classname="Text">{failure}</testcase>
<testcase name="OnAGpu_Draws" status="run" classname="Text"><skipped message="no GPU"/></testcase>
<testcase name="DISABLED_Never" status="notrun" classname="Text"/></testsuite></testsuites>"""
ONE = '<testsuites><testcase name="Draws" status="run" classname="Render"/></testsuites>'
FAILURE = '<failure message="no"/>'


class Summary(unittest.TestCase):
    def summary(self, code, core=None, core_failure=""):
        """(exit code, what is said) where ctest ended with `code`; `core` is the report of core_test itself."""
        with tempfile.TemporaryDirectory() as folder:
            reports, executables = Path(folder, "reports"), Path(folder, "gtest")
            reports.mkdir()
            executables.mkdir()
            (reports / "stages.tsv").write_text(f"ctest\t{code}\t12\nlint\t0\t3\n")
            (reports / "ctest.xml").write_text(
                CTEST.format(core="fail" if core_failure else "run", core_failure=core_failure))
            if core is not None:
                (executables / "core_test.xml").write_text(core)
            (executables / "render_test.xml").write_text(ONE)
            run = subprocess.run([sys.executable, SCRIPT, reports, executables], capture_output=True, text=True,
                                 check=False)
        return run.returncode, run.stdout

    def test_tests_of_executables_are_counted_in_their_place(self):
        code, said = self.summary(0, GTEST.format(failure=""))
        self.assertEqual(code, 0)
        self.assertIn("5 passed, 0 failed", said)  # 2 of core_test, 1 of render_test, hostile.work, lint
        self.assertIn("SKIPPED Text OnAGpu_Draws", said)
        self.assertIn("SKIPPED Text DISABLED_Never", said)

    def test_a_failure_is_named_and_counted_once(self):
        code, said = self.summary(8, GTEST.format(failure=FAILURE), FAILURE)
        self.assertEqual(code, 1)
        self.assertIn("4 passed, 1 failed", said)
        self.assertIn("FAILED Text Empty_Stays", said)

    def test_an_executable_that_crashed_is_a_failure(self):
        code, said = self.summary(8, None, FAILURE)
        self.assertEqual(code, 1)
        self.assertIn("3 passed, 1 failed", said)
        self.assertIn("FAILED core_test", said)

    def test_one_that_crashed_after_its_report_is_a_failure(self):
        code, said = self.summary(8, GTEST.format(failure=""), FAILURE)
        self.assertEqual(code, 1)
        self.assertIn("5 passed, 1 failed", said)
        self.assertIn("FAILED core_test", said)


if __name__ == "__main__":
    unittest.main()
