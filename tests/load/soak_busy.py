"""Soaks a server that is never alone: does its memory stay flat?

Usage: soak_busy.py FROXEL [--minutes 60] [--seed 1] [--csv FILE] [-- OPTIONS OF froxel serve]

One viewer stays for the whole time and three come and go: they orbit, rest, draw with ever other settings and go
over to other scenes. Somebody asks for a still of another scene every second. The server has a folder of four scenes.
The first quarter of the time is warm-up. Passes if after it

  - resident memory is flat: its median in the last quarter is less than a tenth above that in the second;
  - every viewer ended as it should, and the server ends with exit code 0.

Prints a line every minute and the verdict last. Exit code 0: passed; 1: failed; 2: usage.
"""

import argparse
import csv
import itertools
import json
import random
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request
from pathlib import Path

from server import Server, split_arguments, write_halls

SCRIPTS = ("orbit", "scenes", "idle", "storm")
VISITORS = 3
SAMPLE_EVERY_S = 2.0
STILL_EVERY_S = 1.0
MOST_RISE = 0.1
WATCHED = ("process_resident_memory_bytes", "process_heap_used_bytes", "froxel_device_memory_bytes")


def ask_for_stills(url, over):
    """Each of another scene and of another time."""
    with urllib.request.urlopen(f"{url}api/v1/scenes", timeout=60) as answer:
        scenes = [row["id"] for row in json.load(answer)["scenes"]]
    for number, scene in enumerate(itertools.cycle(scenes)):
        try:
            path = f"render?scene={scene}&size=640x360&light_time={number / 16}"
            with urllib.request.urlopen(f"{url}{path}", timeout=70) as answer:
                answer.read()
        except (urllib.error.URLError, OSError):
            pass  # put off, or the scene did not come in time
        if over.wait(STILL_EVERY_S):
            return


class Visitor:
    """One viewer after another."""

    def __init__(self, froxel, url, seed):
        self.froxel, self.url, self.random = froxel, url, random.Random(seed)
        self.process, self.failures, self.count = None, [], 0
        self.scripts = itertools.cycle(self.random.sample(SCRIPTS, len(SCRIPTS)))

    def go_on(self):
        if self.process and self.process.poll() is None:
            return
        self.reap()
        command = [self.froxel, "load", self.url, "--viewers", "1", "--script", next(self.scripts)]
        command += ["--seconds", str(self.random.choice((3, 6, 12)))]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.count += 1

    def reap(self):
        if self.process:
            said = self.process.communicate(timeout=120)[0]
            if self.process.returncode != 0:
                self.failures.append(said.strip().splitlines()[-1:] or [str(self.process.returncode)])
            self.process = None


def soak(server, froxel, options):
    """(samples, visitors)"""
    begin = time.monotonic()
    end = begin + 60 * options.minutes
    visitors = [Visitor(froxel, server.url, options.seed + i) for i in range(VISITORS)]
    watching = [froxel, "load", server.url, "--viewers", "1", "--script", "idle", "--seconds", str(int(60 * options.minutes))]
    watcher = subprocess.Popen(watching, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    samples, next_line = [], begin
    while (now := time.monotonic()) < end:
        for visitor in visitors:
            visitor.go_on()
        sample = server.sample()
        samples.append({"at_s": now - begin, **{name: sample.get(name, 0) for name in WATCHED}})
        if now >= next_line:
            figures = ", ".join(f"{samples[-1][name] / 1e6:.0f} MB" for name in WATCHED)
            print(f"{now - begin:.0f} s: resident, heap, device: {figures}", flush=True)
            next_line = now + 60
        time.sleep(SAMPLE_EVERY_S)
    for visitor in visitors:
        visitor.reap()
    watcher.terminate()
    watcher.wait()
    return samples, visitors


def quarter(samples, number):
    """The median of resident memory in it."""
    part = samples[len(samples) * number // 4 : len(samples) * (number + 1) // 4]
    return statistics.median(sample[WATCHED[0]] for sample in part)


def main():
    arguments, serve_options = split_arguments()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("froxel")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--csv", type=Path, help="all samples")
    options = parser.parse_args(arguments)
    if not 0.5 <= options.minutes <= 1440:
        parser.error("--minutes must be 0.5 to 1440")
    with tempfile.TemporaryDirectory() as folder:
        write_halls(Path(folder), options.froxel)
        server = Server(options.froxel, "--min-fps", "0", "--max-sessions", "32", "--scenes", folder, *serve_options)
        over = threading.Event()
        stills = threading.Thread(target=ask_for_stills, args=(server.url, over), daemon=True)
        try:
            stills.start()
            samples, visitors = soak(server, options.froxel, options)
        finally:
            over.set()
            code = server.stop()
    if options.csv:
        with options.csv.open("w", newline="") as file:
            rows = csv.DictWriter(file, samples[0].keys())
            rows.writeheader()
            rows.writerows(samples)
    second, last = quarter(samples, 1), quarter(samples, 3)
    print(f"resident memory: {second / 1e6:.0f} MB in the second quarter, {last / 1e6:.0f} MB in the last; "
          f"{sum(visitor.count for visitor in visitors)} visitors")
    broken = [f"a viewer failed: {failure}" for visitor in visitors for failure in visitor.failures[:1]]
    if last > (1 + MOST_RISE) * second:
        broken.append(f"resident memory rose by {(last - second) / 1e6:.0f} MB")
    if code != 0:
        broken.append(f"the server ended with {code}")
    print("passed" if not broken else "failed: " + "; ".join(broken))
    return 1 if broken else 0


sys.exit(main())
