"""Measures stills of a server, alone and beside viewers.

Usage: stills.py FROXEL [--rate 200] [--viewers 30] [--seconds 15] [--size 1280x720] [-- OPTIONS OF froxel serve]

--viewers 0 measures stills alone.

Each still is another one (its lights stand elsewhere), so none is given again. Prints

  - the time from a request to its answer's last byte, one after another on one connection;
  - frames a second of so many viewers of `froxel load` without stills and beside so many a second,
    and what of these were answered.
"""

import argparse
import concurrent.futures
import http.client
import itertools
import json
import math
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from server import Server, split_arguments

A_PROCESS = 125  # stills a second that one process asks for; more would wait for its interpreter
THREADS = 16  # of such a process
STRIDE = 100_000  # between the numbers of processes' stills


class Asker:
    """Asks for one still after another; a connection a thread."""

    def __init__(self, url, size, first=0):
        self.authority = url.split("/")[2]
        self.size = size
        self.local = threading.local()
        self.numbers = itertools.count(first)

    def ask(self):
        """Seconds, and the status."""
        number = next(self.numbers)
        if not hasattr(self.local, "connection"):
            self.local.connection = http.client.HTTPConnection(self.authority, timeout=70)
        begin = time.monotonic()
        self.local.connection.request("GET", f"/render?size={self.size}&light_time={number / 16}")
        answer = self.local.connection.getresponse()
        answer.read()
        return time.monotonic() - begin, answer.status


def ask_at(url, size, first, rate, seconds):
    """Stills at this rate by threads of this process; the answers."""
    asker = Asker(url, size, first)
    with concurrent.futures.ThreadPoolExecutor(THREADS) as pool:
        asked = []
        begin = time.monotonic()
        while time.monotonic() < begin + seconds:
            asked.append(pool.submit(asker.ask))
            time.sleep(max(0.0, begin + len(asked) / rate - time.monotonic()))
        return [each.result() for each in asked]


def asked_at(url, size, rate, seconds):
    """Stills at this rate by as many processes as that takes; the answers."""
    count = math.ceil(rate / A_PROCESS)
    with concurrent.futures.ProcessPoolExecutor(count) as pool:
        asked = [pool.submit(ask_at, url, size, (at + 1) * STRIDE, rate / count, seconds) for at in range(count)]
        return [answer for each in asked for answer in each.result()]


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(len(values) * share))]


def told(name, took):
    times = [seconds * 1e3 for seconds, status in took if status == 200]
    refused = len(took) - len(times)
    if not times:
        return f"{name}: none of {len(took)} was answered"
    return (
        f"{name}: {len(times)} answered, {refused} put off; ms p50 {statistics.median(times):.2f} "
        f"p95 {percentile(times, 0.95):.2f} p99 {percentile(times, 0.99):.2f}"
    )


def frames_a_second(froxel, url, viewers, seconds, beside=lambda: None):
    """Of each viewer, and what `beside` gave."""
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        command = [froxel, "load", url, "--viewers", str(viewers), "--seconds", str(seconds), "--json", report.name]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        given = beside()
        if process.wait() != 0:
            sys.exit("a viewer failed")
        rates = [viewer["frames_per_s"] for viewer in json.load(report)["each"]]
        return statistics.mean(rates), given


def main():
    own, serve = split_arguments()
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("froxel")
    parser.add_argument("--rate", type=float, default=200)
    parser.add_argument("--viewers", type=int, default=30)
    parser.add_argument("--seconds", type=int, default=15)
    parser.add_argument("--size", default="1280x720")
    options = parser.parse_args(own)
    with Server(options.froxel, "--max-sessions", "64", *serve) as server:
        asker = Asker(server.url, options.size)
        while asker.ask()[1] == 503:
            time.sleep(0.2)
        for _ in range(20):
            asker.ask()
        print(told("one after another", [asker.ask() for _ in range(200)]), flush=True)
        at_rate = (server.url, options.size, options.rate, options.seconds)
        print(told(f"{options.rate:.0f} a second, no viewers", asked_at(*at_rate)), flush=True)
        run = (options.froxel, server.url, options.viewers, options.seconds)
        for name in ("first", "again") if options.viewers else ():
            alone, _ = frames_a_second(*run)
            beside, took = frames_a_second(*run, lambda: asked_at(*at_rate))
            print(
                f"{options.viewers} viewers, {name}: {alone:.1f} frames a second each alone, "
                f"{beside:.1f} beside stills ({100 * (beside / alone - 1):+.1f} %)"
            )
            print(told(f"  stills, {options.rate:.0f} a second", took), flush=True)


if __name__ == "__main__":
    main()
