"""`froxel bench` from outside, on lavapipe: a tiny run, its report, a comparison, Ctrl-C.

FROXEL_BINARY is its path.
"""

import json
import os
import shlex
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

FROXEL = os.environ["FROXEL_BINARY"]
TINY = ["--device", "cpu", "--preset", "smoke", "--camera", "Nave", "--seconds-per-row", "0.5"]
TEMPLATE = '<html><script type="application/json" id="results">null</script></html>'


def froxel(*arguments):
    # A minute and a half on two quiet cores.
    return subprocess.run([FROXEL, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, check=False)


class Bench(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.kept.cleanup)
        cls.folder = Path(cls.kept.name)
        (cls.folder / "report.html").write_text(TEMPLATE)
        cls.out = cls.folder / "a.json"
        cls.page = cls.folder / "a.html"
        cls.run_ = froxel("bench", *TINY, "--out", cls.out, "--report", cls.page, "--web-root",
                          cls.folder)

    def setUp(self):
        self.assertEqual(self.run_.returncode, 0, self.run_.stderr)
        self.result = json.loads(self.out.read_text())

    def rows(self):
        return [row for sweep in self.result["sweeps"] for row in sweep["rows"]]

    def test_every_row_is_measured_or_left_out_with_a_reason(self):
        self.assertEqual(self.result["schema"], "froxel.bench.v1")
        self.assertTrue(self.result["complete"])
        sweep, = self.result["sweeps"]
        self.assertEqual(len(sweep["rows"]) + len(sweep["skipped"]), 13)
        self.assertGreaterEqual(len(sweep["rows"]), 1)
        for row in sweep["skipped"]:
            self.assertNotEqual(row["reason"], "")

    def test_a_run_joined_is_the_run(self):
        out = self.folder / "joined.json"
        page = self.folder / "joined.html"
        run = froxel("bench", "--join", self.out, "--out", out, "--report", page, "--web-root",
                     self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(out.read_text()), self.result)
        self.assertEqual(page.read_text(), self.page.read_text())
        twice = froxel("bench", "--join", self.out, self.out, "--out", out)
        self.assertEqual(twice.returncode, 2)
        self.assertIn("is there twice", twice.stderr)

    def test_rows_are_exact_and_have_times(self):
        for row in self.rows():
            self.assertEqual(row["error_r1"]["exact"], True, row["label"])
            self.assertGreaterEqual(row["frames"], 8)
            # A driver may write no timestamps.
            told = ["gpu_us"] if row["gpu_us"] else []
            for time in (*told, "host_us", "frame_us", "cpu_us"):
                values = [row[time][name] for name in ("min", "p5", "median", "p95", "p99", "max")]
                self.assertEqual(values, sorted(values))
                self.assertEqual(len(row["samples"][time]), row["frames"])
                self.assertGreater(row[time]["min"], 0)
            self.assertGreater(len(row["passes"]), 0)

    def test_a_rows_command_draws_its_settings(self):
        row = self.rows()[0]
        arguments = shlex.split(row["command"])
        self.assertEqual(arguments[0], "froxel")
        timings = self.folder / "timings.json"
        arguments[arguments.index("timings.json")] = str(timings)
        run = froxel(*arguments[1:])
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads(timings.read_text())
        self.assertEqual(report["settings"], row["settings"])
        self.assertEqual(report["frames"], row["frames"])
        lists = [{name: value for name, value in told["light_lists"].items() if name != "why"}
                 for told in (report["last_frame"], row)]  # words with a rounded sum, whose order is open
        self.assertEqual(*lists)

    def test_report_holds_the_results(self):
        head, tail = TEMPLATE.split("null")
        page = self.page.read_text()
        self.assertTrue(page.startswith(head) and page.endswith(tail))
        self.assertEqual(json.loads(page[len(head):-len(tail)]), self.result)

    def test_compare_with_itself_is_0_and_prints_every_row(self):
        run = froxel("bench", "--compare", self.out, self.out)
        self.assertEqual(run.returncode, 0, run.stderr)
        for row in self.rows():
            self.assertIn(row["label"], run.stdout)

    def test_compare_with_a_slower_run_is_1(self):
        slower = json.loads(self.out.read_text())
        for sweep in slower["sweeps"]:
            for row in sweep["rows"]:
                row["samples"]["cpu_us"] = [2 * t + 1 for t in row["samples"]["cpu_us"]]
        path = self.folder / "slower.json"
        path.write_text(json.dumps(slower))
        self.assertEqual(froxel("bench", "--compare", self.out, path).returncode, 1)

    def test_views_are_taken_along_a_path(self):
        path, out = self.folder / "path.json", self.folder / "along.json"
        keys = [{"eye": [x, 2, 1], "target": [x, 2, 0]} for x in (0, 4)]
        path.write_text(json.dumps({"seconds": 4, "keys": keys}))
        few = ["--device", "cpu", "--preset", "view", "--size", "64x36", "--lights", "20", "--seconds-per-row", "0.01",
               "--error-size", "16x16", "--r1-pairs", "0", "--r2-pairs", "0", "--path", path]
        run = froxel("bench", *few, "--path-stops", "3", "--out", out)
        self.assertEqual(run.returncode, 0, run.stderr)
        views = json.loads(out.read_text())["views"]
        self.assertEqual([view["name"] for view in views], [f"{x},2,1;{x},2,0;45" for x in (0, 2, 4)])
        self.assertEqual([view["time_s"] for view in views], [0, 2, 4])
        path.write_text(json.dumps({"keys": [{**keys[0], "up": [1, 1, 0]}]}))
        run = froxel("bench", *few, "--out", out)
        self.assertEqual(run.returncode, 2)
        self.assertIn("--path: the camera is not upright at 0 s", run.stderr)

    def test_usage_errors_are_2_before_anything_is_drawn(self):
        for arguments in ([], ["--preset", "nothing", "--out", "a.json"],
                          ["--compare", self.out, self.page],
                          ["--camera", "1;2", "--out", "a.json"]):
            self.assertEqual(froxel("bench", *arguments).returncode, 2, arguments)

    def test_missing_template_or_folder_is_1_before_anything_is_drawn(self):
        run = froxel("bench", *TINY, "--out", self.folder / "b.json", "--report",
                     self.folder / "b.html", "--web-root", self.folder / "absent")
        self.assertEqual(run.returncode, 1)
        self.assertIn("absent", run.stderr)
        run = froxel("bench", *TINY, "--out", self.folder / "absent" / "b.json")
        self.assertEqual(run.returncode, 1)

    def test_list_names_every_preset(self):
        run = froxel("bench", "--list")
        self.assertEqual(run.returncode, 0)
        for name in ("light_count", "resolution", "grid", "gbuffer", "stream", "smoke"):
            self.assertIn(name, run.stdout)

    def test_signal_keeps_what_is_measured(self):
        out = self.folder / "stopped.json"
        with subprocess.Popen([FROXEL, "bench", "--device", "cpu", "--preset", "light_count",
                               "--size", "64x36", "--camera", "Nave", "--seconds-per-row", "30",
                               "--out", out], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as run:
            with self.assertRaises(subprocess.TimeoutExpired):
                run.wait(2)
            run.send_signal(signal.SIGINT)
            _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 130, errors)
        result = json.loads(out.read_text())
        self.assertFalse(result["complete"])
        sweep, = result["sweeps"]
        self.assertEqual(len(sweep["rows"]) + len(sweep["skipped"]), 75)


if __name__ == "__main__":
    unittest.main()
