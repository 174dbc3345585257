"""What deploy/summarize_tests.py counts."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "deploy/summarize_tests.py"
# As ctest writes it: two executables as a whole, and a test that is none.
CTEST = """<testsuite><testcase name="core_test" status="{core}">{core_failure}</testcase>
<testcase name="render_test" status="run" time="99"/><testcase name="hostile.work" status="run" time="7.5"/></testsuite>"""
GTEST = """<testsuites><testsuite name="Text"><testcase name="Long_IsCut" status="run" classname="Text"/>
<testcase name="Empty_Stays" status="run" classname="Text">{failure}</testcase>
<testcase name="OnAGpu_Draws" status="run" classname="Text"><skipped message="no GPU"/></testcase>
<testcase name="DISABLED_Never" status="notrun" classname="Text"/></testsuite></testsuites>"""
ONE = '<testsuites><testcase name="Draws" status="run" classname="Render" time="8.25"/></testsuites>'
FAILURE = '<failure message="no"/>'


class Summary(unittest.TestCase):
    def summary(self, code, core=None, core_failure="", seconds=12):
        """(exit code, what is said) where ctest ended with `code`; `core` is the report of core_test itself."""
        with tempfile.TemporaryDirectory() as folder:
            reports, executables = Path(folder, "reports"), Path(folder, "gtest")
            reports.mkdir()
            executables.mkdir()
            (reports / "stages.tsv").write_text(f"build\t-\t90\t100\nctest\t{code}\t{seconds}\t15\nlint\t0\t3\t2\n")
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

    def test_a_failure_says_why_by_its_first_and_last_lines(self):
        log = "\n".join(["died of SIGSEGV", *(f"line {i}" for i in range(40)), "the last"])
        _, said = self.summary(8, GTEST.format(failure=f'<failure message="short">{log}</failure>'), FAILURE)
        self.assertIn("FAILED Text Empty_Stays\n    died of SIGSEGV\n    line 0\n    line 1\n    ...\n    line 33\n", said)
        self.assertIn("    line 39\n    the last\n\n", said)

    def test_a_failure_of_ctest_says_the_end_of_its_output(self):
        failure = '<failure message="Failed"/><system-out>all is ready\nvalue is 3; it must be 4</system-out>'
        _, said = self.summary(8, None, failure)
        self.assertIn("FAILED core_test\n    Failed\n    all is ready\n    value is 3; it must be 4\n", said)

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

    def test_the_dearest_tests_are_those_of_executables(self):
        _, said = self.summary(0, GTEST.format(failure=""))
        self.assertIn("     8.2  Render Draws\n     7.5  hostile.work\n", said)
        self.assertNotIn("render_test", said)

    def test_what_took_longer_than_all_may_names_the_stage_that_grew(self):
        code, said = self.summary(0, GTEST.format(failure=""), seconds=25)
        self.assertEqual(code, 0)
        self.assertIn("all took 118 s; on two cores 117 s are meant", said)
        self.assertIn("SLOW: ctest grew most, to 25 s where 15 s are meant", said)
        _, said = self.summary(0, GTEST.format(failure=""), seconds=24)
        self.assertNotIn("SLOW", said)


if __name__ == "__main__":
    unittest.main()
