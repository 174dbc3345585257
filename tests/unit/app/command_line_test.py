"""The built binary from outside: exit codes, one-line errors, files.

FROXEL_BINARY is its path. Everything is drawn by lavapipe, so that a machine's GPU makes no difference.
"""

import array
import json
import os
import socket
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

FROXEL = os.environ["FROXEL_BINARY"]
# All of these runs share it; this user's may hold what another build left there.
CACHE = tempfile.TemporaryDirectory()
SMALL = ["--device", "cpu", "--size", "64x36", "--lights", "20", "--warmup", "0"]


def froxel(*arguments, **environment):
    return subprocess.run([FROXEL, *map(str, arguments)],
                          env={**os.environ, "XDG_CACHE_HOME": CACHE.name, **environment},
                          capture_output=True, text=True, timeout=120, check=False)


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def assert_refused(self, run, code, *parts):
        """Exit code `code`, nothing on stdout, and one line on stderr with all the parts."""
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(run.stdout, "")
        errors = [line for line in run.stderr.splitlines() if line.startswith("froxel: ")]
        self.assertEqual(len(errors), 1, run.stderr)
        for part in parts:
            self.assertIn(part, errors[0])

    def render(self, name, *arguments):
        out = self.folder / name
        run = froxel("render", *SMALL, "--out", out, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "")
        return out.read_bytes()

    def test_usage_is_2(self):
        self.assert_refused(froxel(), 2, "subcommand")
        self.assert_refused(froxel("render", "--out", "a.png", "--lights", "many"), 2,
                            "--lights", "'many'", "0 to 100000")

    def test_unknown_camera_is_2_and_names_those_there_are(self):
        run = froxel("render", *SMALL, "--out", self.folder / "a.png", "--camera", "Crypt")
        self.assert_refused(run, 2, "'Crypt'", "Nave")

    def test_missing_scene_is_3(self):
        run = froxel("info", "--scene", self.folder / "absent.glb")
        self.assert_refused(run, 3, "absent.glb")

    def test_no_device_is_4(self):
        for command in (["info"], ["render", "--out", self.folder / "a.png"]):
            run = froxel(*command, VK_ICD_FILENAMES="/nonexistent.json",
                         VK_DRIVER_FILES="/nonexistent.json")
            self.assert_refused(run, 4, "no Vulkan driver", "mesa-vulkan-drivers")

    def test_taken_address_is_5(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            run = froxel("serve", "--device", "cpu", "--port", port, "--admin-bind", "none",
                         "--log-level", "error")
            self.assert_refused(run, 5, str(port))

    def test_unwritable_output_is_1_before_anything_is_drawn(self):
        run = froxel("render", *SMALL, "--out", self.folder / "absent" / "a.png")
        self.assert_refused(run, 1, "absent")

    def test_closed_standard_streams_lead_nowhere(self):
        out = self.folder / "closed.png"
        closed = subprocess.run(["sh", "-c", 'exec "$@" 0<&- 1>&- 2>&-', "sh", FROXEL, "render", *SMALL,
                                 "--out", out, "--log-level", "debug"],
                                env={**os.environ, "XDG_CACHE_HOME": CACHE.name}, timeout=120, check=False)
        self.assertEqual(closed.returncode, 0)
        self.assertEqual(out.read_bytes(), self.render("open.png"))

    def test_results_that_standard_output_does_not_take_are_1(self):
        reader, pipe = os.pipe()
        os.close(reader)
        with open("/dev/full", "wb") as full, os.fdopen(pipe, "wb") as left:
            for stdout, reason in ((full, "No space left"), (left, "Broken pipe")):
                run = subprocess.run([FROXEL, "--help"], stdout=stdout, stderr=subprocess.PIPE, text=True,
                                     timeout=60, check=False)
                self.assertEqual(run.returncode, 1)
                self.assertRegex(run.stderr, f"^froxel: standard output .*: {reason}.*\n$")

    def test_help_and_version_are_0(self):
        for arguments in (["--help"], ["--version"], ["render", "--help"], ["--help-all"]):
            run = froxel(*arguments)
            self.assertEqual(run.returncode, 0)
            self.assertEqual(run.stderr, "")
            self.assertNotEqual(run.stdout, "")

    def test_png_has_the_size_asked_for(self):
        png = self.render("a.png")
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", png[16:24]), (64, 36))

    def test_jpeg_is_one(self):
        jpeg = self.render("a.jpg", "--quality", "50", "--chroma", "444")
        self.assertEqual((jpeg[:2], jpeg[-2:]), (b"\xff\xd8", b"\xff\xd9"))

    def test_pfm_is_linear_float_and_not_black(self):
        pfm = self.render("a.pfm", "--renderer", "naive")
        header = b"PF\n64 36\n-1.0\n"
        self.assertEqual(pfm[:len(header)], header)
        values = array.array("f", pfm[len(header):])
        self.assertEqual(len(values), 64 * 36 * 3)
        self.assertGreater(max(values), 0)
        self.assertTrue(all(value >= 0 for value in values))

    def test_render_names_its_files_and_info_says_what_a_picture_is(self):
        out, timings = self.folder / "a.png", self.folder / "t.json"
        run = froxel("render", *SMALL, "--out", out, "--timings", timings)
        self.assertEqual(run.stdout.splitlines()[-2:], [f"wrote {out}", f"wrote {timings}"])
        told = json.loads(froxel("info", out, "--json").stdout)
        self.assertEqual(told, {"picture": {"type": "image/png", "width_px": 64, "height_px": 36}})
        broken = self.folder / "broken.png"
        broken.write_bytes(out.read_bytes()[:20])
        self.assert_refused(froxel("info", broken), 3, "broken.png")

    def test_exr_holds_the_floats_of_pfm(self):
        exr, pfm = self.render("a.exr"), self.render("a.pfm")
        self.assertEqual(exr[:4], b"\x76\x2f\x31\x01")  # OpenEXR's magic number
        self.assertGreater(len(exr), 64 * 36 * 12)
        # Its last line has the line's channels one after the other, in the order B, G, R, Z.
        channels = array.array("f", exr[-64 * 16:])
        blues, greens, reds, depths = (channels[at:at + 64] for at in range(0, 256, 64))
        first_row = array.array("f", pfm[-64 * 36 * 12:][: 64 * 12])  # a .pfm begins at the bottom
        self.assertEqual(reds, first_row[0::3])
        self.assertEqual(greens, first_row[1::3])
        self.assertEqual(blues, first_row[2::3])
        self.assertTrue(all(depth > 0 for depth in depths))

    def test_view_without_a_look_is_what_the_page_begins_with(self):
        self.assertEqual(self.render("a.pfm"), self.render("b.pfm", "--look", "evening"))
        self.assertNotEqual(self.render("a.pfm"), self.render("c.pfm", "--look", "none"))

    def test_same_options_same_bytes_and_another_seed_others(self):
        first = self.render("a.pfm", "--time", "1.5")
        self.assertEqual(first, self.render("b.pfm", "--time", "1.5"))
        self.assertNotEqual(first, self.render("c.pfm", "--time", "1.5", "--seed", "2"))

    def test_comparison_is_measured_and_decides_the_exit_code(self):
        settings = ["render", "--device", "cpu", "--size", "160x90", "--lights", "60", "--compare"]
        timings, picture = self.folder / "compared.json", self.folder / "compared.png"
        run = froxel(*settings, "as-set", "light_loop:all_lights", "--max-flip", "0", "--timings", timings, "--out",
                     picture)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("\nequal, 14400 pixels compared\n", run.stdout)
        compared = json.loads(timings.read_text())["compared"]
        self.assertEqual((compared["differing"], compared["flip"], compared["promised"]), (0, 0, True))
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))
        run = froxel(*settings, "exposure:1", "exposure:4", "--max-flip", "0.01")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("of 14400 pixels differ, by at most ", run.stdout)
        self.assertIn("; the first is (0, 0): #", run.stdout)
        for wrong, words in ((["seed:1", "as-set"], "seed is the same on both sides"),
                             (["as-set", "renderer:fast"], "renderer: 'fast' is not naive, "),
                             (["as-set", "as-set", "--out", "a.exr"], "writes .png or .jpg, --out is 'a.exr'")):
            run = froxel(*settings, *wrong)
            self.assertEqual(run.returncode, 2, run.stdout)
            self.assertIn(words, run.stderr)

    def test_path_draws_every_frame_of_it(self):
        path, out = self.folder / "path.json", self.folder / "frames"
        path.write_text(json.dumps({"seconds": 0.4, "keys": [
            {"eye": [-9, 2, 0], "target": [0, 2, 0]}, {"eye": [-5, 2, 0], "target": [0, 2, 0]}]}))
        run = froxel("render", *SMALL, "--path", path, "--fps", "10", "--out", f"{out}/")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("4 frames of 64x36", run.stdout)
        frames = sorted(out.iterdir())
        self.assertEqual([frame.name for frame in frames], [f"{i:05}.png" for i in range(1, 5)])
        self.assertEqual(len({frame.read_bytes() for frame in frames}), 4)
        still = self.render("still.png", "--camera", "-9,2,0;0,2,0;45", "--time", "0")
        self.assertEqual(frames[0].read_bytes(), still)
        for wrong, words in (([path, "--out", "frames.txt"], "frames.txt"),
                             (["orbit", "--out", f"{out}/"], "cannot read 'orbit'")):
            run = froxel("render", *SMALL, "--path", *wrong)
            self.assertNotEqual(run.returncode, 0)
            self.assertIn(words, run.stderr)
        path.write_text('{"keys": [{"eye": [0, 0, 0], "target": [0, 0, 0]}]}')
        run = froxel("render", *SMALL, "--path", path, "--out", f"{out}/")
        self.assert_refused(run, 2, "path.json: keys[0].target is 0 m from the eye")
        self.assert_refused(froxel("render", *SMALL, "--out", f"{out}/"), 2, "is a folder, which needs --path")

    def test_record_writes_a_video(self):
        out = self.folder / "film.webm"
        out.write_text("before")
        run = froxel("record", *SMALL, "--seconds", "0.5", "--fps", "10", "--out", out, "--path", "nowhere.json")
        self.assert_refused(run, 2, "--seconds excludes --path")
        run = froxel("record", *SMALL, "--path", "nowhere.json", "--out", out)
        self.assert_refused(run, 1, "cannot read 'nowhere.json'")
        self.assertEqual(out.read_text(), "before")
        run = froxel("record", *SMALL, "--seconds", "0.5", "--fps", "10", "--out", out)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertRegex(run.stdout, r"recorded 1 of 5 frames\n(?s:.*)wrote .*film.webm: 5 frames of 64x36, 0.5 s, 0.0 MB\n$")
        video = out.read_bytes()
        self.assertEqual(video[:4], b"\x1a\x45\xdf\xa3")
        self.assertIn(b"webm", video[:64])
        self.assertIn(b"V_VP9", video[:512])
        self.assertEqual([file.name for file in self.folder.iterdir() if "film" in file.name], ["film.webm"])
        for wrong, words in ((["--out", "film.mp4"], "'film.mp4' is not a .webm file"), ([], "--out is required"),
                             (["--out", out, "--crf", "64"], "64"),
                             (["--out", out, "--seconds", "3600", "--fps", "1000"], "a recording of 3600000 frames")):
            self.assert_refused(froxel("record", *SMALL, *wrong), 2, words)

    def test_mean16_is_the_mean_of_16_frames(self):
        out = self.folder / "a.png"
        run = froxel("render", *SMALL, "--out", out, "--antialiasing", "mean16")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(run.stdout.startswith("16 frames of"), run.stdout)
        self.assertNotEqual(out.read_bytes(), self.render("b.png"))
        self.assertEqual(out.read_bytes(), self.render("c.png", "--antialiasing", "mean16"))
        mean, plain = (array.array("f", self.render("d.pfm", "--antialiasing", name)[-4 * 3 * 64:])
                       for name in ("mean16", "none"))
        self.assertNotEqual(mean, plain)
        self.assertAlmostEqual(sum(mean) / sum(plain), 1, delta=0.2)

    def test_last_of_k_frames_is_the_frame_of_its_time(self):
        last = self.render("a.pfm", "--time", "1", "--frames", "4")
        self.assertEqual(last, self.render("b.pfm", "--time", repr(1 + 3 * (1 / 30))))
        self.assertNotEqual(last, self.render("c.pfm", "--time", "1", "--frames", "4",
                                              "--no-animate"))

    def test_timings_have_every_statistic(self):
        timings = self.folder / "t.json"
        run = froxel("render", *SMALL, "--frames", "3", "--timings", timings)
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads(timings.read_text())
        self.assertEqual(report["schema"], "froxel.timings.v1")
        self.assertEqual(report["frames"], 3)
        self.assertEqual(report["device"]["kind"], "cpu")
        self.assertGreater(len(report["passes"]), 0)
        told = [*report["frame"].values(), *(p["gpu_us"] for p in report["passes"])]
        # A driver may write no timestamps.
        for times in filter(None, told):
            self.assertLessEqual(0, times["min"])
            self.assertLessEqual(times["min"], times["median"])
            self.assertLessEqual(times["median"], times["p95"])
            self.assertLessEqual(times["p95"], times["max"])
        for time in ("host_us", "frame_us"):
            self.assertGreater(report["frame"][time]["min"], 0)
        if report["frame"]["gpu_us"]:
            self.assertGreater(report["frame"]["gpu_us"]["min"], 0)
        last = report["last_frame"]
        self.assertTrue(last["grid"]["automatic"])
        self.assertEqual(len(last["grid"]["size"]), 3)
        self.assertIsNone(last["pairs"])

    def test_settings_that_never_change_the_picture_do_not(self):
        first = self.render("a.pfm")
        for options in (["--grid", "7x5x9"], ["--grid-law", "linear"],
                        ["--light-loop", "all_lights"], ["--lighting", "fragment"]):
            self.assertEqual(first, self.render("b.pfm", *options), options)
        self.assertNotEqual(first, self.render("c.pfm", "--shading", "lambert"))
        self.assertNotEqual(first, self.render("c.pfm", "--lens-shift", "0.5,0"))

    def test_info_as_json_is_all_that_stdout_has(self):
        run = froxel("info", "--device", "cpu", "--scene", "builtin", "--json",
                     "--log-level", "debug")
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads(run.stdout)
        self.assertGreaterEqual(report["scene"]["triangles"], 100_000)
        self.assertEqual(len(report["scene"]["cameras"]), 6)
        self.assertEqual(report["device"]["kind"], "cpu")
        self.assertGreater(report["limits"]["max_picture_side_px"], 0)
        self.assertTrue(report["frame"]["grid"]["automatic"])
        self.assertIn("memory_bytes", report["frame"])

    def test_scene_writes_the_hall_and_reads_it_back(self):
        hall = self.folder / "hall.glb"
        run = froxel("scene", "--out", hall)
        self.assertEqual(run.returncode, 0, run.stderr)
        glb = hall.read_bytes()
        self.assertEqual(struct.unpack("<4sII", glb[:12]), (b"glTF", 2, len(glb)))
        reports = [json.loads(froxel("info", "--device", "cpu", "--scene", scene, "--json").stdout)
                   for scene in ("builtin", hall)]
        for key in ("triangles", "draws", "materials", "cameras", "lights"):
            self.assertEqual(reports[0]["scene"][key], reports[1]["scene"][key], key)

    def test_scene_writes_a_field_of_spheres(self):
        field = self.folder / "field.glb"
        run = froxel("scene", "--out", field, "--spheres", "2000", "--copies", "3")
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads(froxel("info", "--device", "cpu", "--scene", field, "--json").stdout)["scene"]
        self.assertGreaterEqual(report["triangles"], 6000)
        self.assertLess(report["triangles"], 8000)
        alone = froxel("scene", "--out", field, "--copies", "3")
        self.assertEqual(alone.returncode, 2)
        self.assertIn("--copies requires --spheres", alone.stderr)


if __name__ == "__main__":
    unittest.main()
