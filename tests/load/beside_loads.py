"""Measures what loads of scenes cost a viewer who watches another one.

Usage: beside_loads.py FROXEL FOLDER [--seconds 12] [-- OPTIONS OF froxel serve]

For each scene of the folder: how long it takes from the request to a picture of it, and the viewer's
intervals between frames, without and beside the load, which begins after a quarter of the time.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

from server import Server, split_arguments


def watched(froxel, url, seconds, beside=None):
    """Milliseconds from frame to frame at the 50th and 99th percentile, and the longest wait for one."""
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        command = [froxel, "load", url, "--viewers", "1", "--seconds", str(seconds), "--json", report.name]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        if beside:
            beside()
        if process.wait() != 0:
            sys.exit("the viewer failed")
        viewer = json.load(report)["each"][0]
        return viewer["interval_ms"]["median"], viewer["interval_ms"]["p99"], viewer["stall_ms"]


def get(url):
    try:
        with urllib.request.urlopen(url, timeout=120) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


def main():
    own, serve = split_arguments()
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("froxel")
    parser.add_argument("folder")
    parser.add_argument("--seconds", type=int, default=12)
    options = parser.parse_args(own)
    with Server(options.froxel, "--scenes", options.folder, *serve) as server:
        watched(options.froxel, server.url, 2)  # the scene is there, and its variants
        scenes = json.loads(get(f"{server.url}api/v1/scenes?limit=200")[1])["scenes"]
        for scene in scenes:
            if scene["kind"] == "builtin":
                continue
            alone = watched(options.froxel, server.url, options.seconds)
            came = []

            def load(path=scene["thumb"], came=came):
                time.sleep(options.seconds / 4)
                begin = time.monotonic()
                status, body = get(server.url + path.lstrip("/"))
                came.append(f"{status}, {len(body)} bytes after {time.monotonic() - begin:.2f} s")

            thread = threading.Thread(target=load)
            beside = watched(options.froxel, server.url, options.seconds, thread.start)
            thread.join()
            words = ["{:.1f}/{:.1f}/{:.1f}".format(*of) for of in (alone, beside)]
            print(
                f"{scene['name']} ({scene['bytes'] / 1e6:.0f} MB): {came[0]}; intervals ms p50/p99/longest "
                f"{words[0]} alone, {words[1]} beside",
                flush=True,
            )


if __name__ == "__main__":
    main()
