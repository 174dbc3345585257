"""Measures what viewers who compare two settings cost one who does not.

Usage: comparing_viewers.py FROXEL [--viewers 3] [--seconds 12] [--size 640x360] [--right renderer:naive]
       [-- OPTIONS OF froxel serve]

One viewer orbits. Beside it are so many viewers who also orbit, and then as many who compare the view with what --right
changes of it while their camera moves. Shares are fair where the first viewer has about the same figures in
both, and better ones than those who compare.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from server import Server, split_arguments


def comparing(seconds, right):
    """Lines of a script: a comparison, and a camera that moves 60 times a second."""
    yield {"at_ms": 0, "setCompare": {"right": right}}
    for i in range(60 * seconds):
        yield {"at_ms": i * 1000 // 60,
               "setCamera": {"eye": {"x": -7 + i % 120 / 20, "y": 2}, "target": {"x": 4, "y": 2}}}


def load(options, url, script, viewers, report):
    return subprocess.Popen(
        [options.froxel, "load", url, "--viewers", str(viewers), "--size", options.size, "--seconds",
         str(options.seconds), "--script", script, "--json", report], stdout=subprocess.DEVNULL)


def measure(options, url, script):
    """The figures of the viewer who orbits, and of those beside it."""
    with tempfile.NamedTemporaryFile(suffix=".json") as own, tempfile.NamedTemporaryFile(suffix=".json") as others:
        runs = [load(options, url, script, options.viewers, others.name), load(options, url, "orbit", 1, own.name)]
        if any([run.wait() != 0 for run in runs]):  # a list: both are waited for
            sys.exit("froxel load failed")
        return json.load(own)["each"][0], json.load(others)["each"]


def told(what, figures):
    """A line of figures; returns the frame rate of the viewer who orbits."""
    own, others = figures
    rate = sum(viewer["frames_per_s"] for viewer in others) / len(others)
    print(f"{what:<20}{own['frames_per_s']:8.1f}{own['latency_ms']['median']:10.1f}{own['latency_ms']['p99']:10.1f}"
          f"{own['stall_ms']:10.0f}{rate:14.1f}", flush=True)
    return own["frames_per_s"]


def main():
    own, serve = split_arguments()
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("froxel")
    parser.add_argument("--viewers", type=int, default=3)
    parser.add_argument("--seconds", type=int, default=12)
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--right", default="renderer:naive")
    options = parser.parse_args(own)
    with tempfile.TemporaryDirectory() as folder, Server(options.froxel, *serve) as server:
        script = Path(folder, "comparing.jsonl")
        script.write_text("".join(json.dumps(line) + "\n" for line in comparing(options.seconds + 30, options.right)))
        print(f"{'beside it':<20}{'fps':>8}{'p50 ms':>10}{'p99 ms':>10}{'stall ms':>10}{'others fps':>14}")
        measure(options, server.url, "orbit")  # every pipeline is there
        measure(options, server.url, script)
        plain = told(f"{options.viewers} who orbit", measure(options, server.url, "orbit"))
        beside = told(f"{options.viewers} who compare", measure(options, server.url, script))
        print(f"the viewer who orbits has {beside / plain:.2f} of its frames beside those who compare")


if __name__ == "__main__":
    main()
