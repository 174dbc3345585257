#!/usr/bin/env python3
"""Draws generated fields of spheres in full and with detail levels, and prints a table.

Usage: large_scenes.py FROXEL [FIELD...] [-- OPTION...]

A FIELD is TRIANGLES or TRIANGLESxCOPIES, such as 1000000x1000. Options go to `froxel render`, such
as --device gpu. Scenes, timings and caches are in a folder that is deleted at the end: the first row
of a field makes its meshlets, the second its levels, the third reads them.
"""

import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FIELDS = ["1000000", "10000000", "40000000", "1000000x1000"]
ERRORS_PX = [0, 1, 4]
FRAMES = 200
WARMUP_FRAMES = 1000  # an idle GPU takes about half a second to raise its clock


def draw(froxel: str, scene: Path, error_px: float, options: list[str]) -> dict:
    timings = scene.with_suffix(f".{error_px}.json")
    command = [froxel, "render", "--scene", str(scene), "--camera", "Field", "--size", "1920x1080"]
    command += ["--lights", "5000", "--environment", "off", "--geometry-error", str(error_px)]
    command += ["--frames", str(FRAMES), "--warmup", str(WARMUP_FRAMES), "--timings", str(timings)]
    command += ["--log-level", "info", "--pipeline-cache", str(scene.parent / "cache"), *options]
    start = time.monotonic()
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode != 0:
        return {"problem": (ran.stderr or ran.stdout).strip().splitlines()[-1]}
    report = json.loads(timings.read_text())
    report["command_s"] = time.monotonic() - start
    packed = re.search(r"event=scene_packed.*device_bytes=(\d+)", ran.stdout + ran.stderr)
    report["device_bytes"] = int(packed.group(1)) if packed else None
    return report


def row(field: str, error_px: float, report: dict) -> str:
    if "problem" in report:
        return f"| {field} | {error_px} px | {report['problem']} | | | |"
    passes = sorted(report["passes"], key=lambda one: -one["gpu_us"]["median"])[:3]
    longest = ", ".join(f"{one['name']} {one['gpu_us']['median'] / 1000:.2f}" for one in passes)
    memory = report["device_bytes"]
    cells = [
        field,
        f"{error_px} px",
        f"{report['frame']['gpu_us']['median'] / 1000:.2f} ms",
        longest,
        f"{report['command_s']:.1f} s",
        f"{memory / 1e6:.0f} MB" if memory else "",
    ]
    return "| " + " | ".join(cells) + " |"


def main() -> int:
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1 :] if "--" in arguments else []
    given = arguments[: arguments.index("--")] if "--" in arguments else arguments
    if not given:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    froxel, fields = given[0], given[1:] or FIELDS
    print("| field | error | GPU | longest passes, ms | whole command | device memory |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for field in fields:
            triangles, _, copies = field.partition("x")
            scene = Path(folder) / f"{field}.glb"
            made = [froxel, "scene", "--out", str(scene), "--spheres", triangles]
            subprocess.run(made + (["--copies", copies] if copies else []), check=True,
                           stdout=subprocess.DEVNULL)
            for error_px in ERRORS_PX:
                print(row(field, error_px, draw(froxel, scene, error_px, options)), flush=True)
            scene.unlink()
    return 0


if __name__ == "__main__":
    sys.exit(main())
