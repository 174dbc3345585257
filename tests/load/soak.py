"""Viewers join and leave a server for half an hour; says whether it holds on to anything.

Usage: soak.py FROXEL [--minutes 30] [--joins-per-minute 50] [--scripts orbit,idle,storm] [--seed 1]
       [-- OPTIONS OF froxel serve]

Starts `FROXEL serve` and, again and again, `FROXEL load` with one viewer for some seconds, by the
scripts in turn, for 45 s; then it lets all of them leave, looks at the server at rest, and begins
anew. Reads the server's /metrics every two seconds. The first fifth of the time (at least 60 s where
that is less than half) is warm-up. Passes if after it

  - what is allocated of the heap at rest rises by less than 8 MB from the first to the last third of
    the rounds, by their medians; with storms by less than a tenth: which variants of pipelines are
    kept, 4 MB each, changes with each, by more than 50 MB from round to round;
  - resident memory at rest rises by less than a tenth, likewise: it has holes besides, which come and
    go by the order in which things end; both where there are at least six rounds;
  - descriptors and sessions are back where they were before the first viewer, once all have left;
  - device memory with no viewer left is what it was after the first round, within 1 %: what viewers share is made when
    the first of them needs it;
  - the server answered every scrape within 5 s, every viewer ended as it should, and the server ends
    with exit code 0.

Prints a line every half minute and the verdict last. Exit code 0: passed; 1: failed; 2: usage.
"""

import argparse
import random
import statistics
import subprocess
import sys
import time

from server import Server, split_arguments

SCRIPTS = ("orbit", "idle", "storm")
HEAP_RISE_BYTES = 8e6
NOISY_RISE = 0.1
SAMPLE_EVERY_S = 2.0
ROUND_S = 45.0
GRACE_S = 2
SAMPLES_AT_REST = 3  # a second apart: the render thread frees what a session held after it has ended


def settle(server, device_bytes=None):
    """Waits until no session is left; with device_bytes also until the device's memory is no more than that, but for
    1 %. None when it never happens, and a line of what is left."""
    end = time.monotonic() + 60
    at_rest = 0
    while time.monotonic() < end:
        values = server.sample()
        device = values["froxel_device_memory_bytes"] if device_bytes else 0
        alone = values["froxel_sessions"] == 0
        at_rest = at_rest + 1 if alone and device - (device_bytes or 0) <= 0.01 * device else 0
        if at_rest == SAMPLES_AT_REST:
            return values
        time.sleep(1)
    print(f"left: {values['froxel_sessions']:.0f} sessions; device memory by purpose: {server.of_device()}, "
          f"{(device_bytes or 0) / 1e6:.2f} MB before")
    return None


class Viewers:
    def __init__(self, froxel, url, scripts, seed):
        self.froxel, self.url, self.scripts = froxel, url, scripts
        self.random = random.Random(seed)
        self.running, self.started, self.failures = [], 0, []

    def start(self):
        script = self.scripts[self.started % len(self.scripts)]
        seconds = self.random.choice((2, 4, 6, 8))
        self.run(script, seconds)

    def run(self, script, seconds):
        command = [self.froxel, "load", self.url, "--viewers", "1", "--script", script]
        command += ["--seconds", str(seconds)]
        self.started += 1
        self.running.append(
            subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        )

    def reap(self, wait=False):
        for process in list(self.running):
            if wait:
                process.wait(60)
            if process.poll() is not None:
                self.running.remove(process)
                said = process.stdout.read()
                process.stdout.close()
                if process.returncode != 0:
                    self.failures.append(said.strip().splitlines()[-1:] or [str(process.returncode)])


def thirds(samples, name):
    """Medians of a value's first and last third."""
    count = max(1, len(samples) // 3)
    return (
        statistics.median(sample[name] for sample in samples[:count]),
        statistics.median(sample[name] for sample in samples[-count:]),
    )


def line(seconds, started, sample):
    print(
        f"{seconds:.0f} s: {started} joined, "
        f"{sample['froxel_viewers']:.0f} there, "
        f"{sample['process_resident_memory_bytes'] / 1e6:.1f} MB, "
        f"{sample['process_heap_used_bytes'] / 1e6:.1f} MB of the heap, "
        f"{sample['process_open_fds']:.0f} descriptors, "
        f"{sample.get('froxel_device_memory_bytes', 0) / 1e6:.1f} MB on the device",
        flush=True,
    )


def busy_round(server, viewers, end, joins_per_minute):
    """Joins until `end`; samples, the last with viewers there."""
    samples = []
    next_join = next_sample = time.monotonic()
    while (now := time.monotonic()) < end:
        if now >= next_join:
            viewers.start()
            next_join += 60 / joins_per_minute
        if now >= next_sample:
            samples.append(server.sample())
            next_sample = now + SAMPLE_EVERY_S
        viewers.reap()
        time.sleep(0.05)
    return samples


def soak(server, viewers, minutes, joins_per_minute):
    """Samples of a busy server and at rest, after the warm-up, and the first at rest."""
    begin = time.monotonic()
    end = begin + minutes * 60
    warm = begin + max(minutes * 60 / 5, min(60, minutes * 30))
    busy, rests, first = [], [], None
    while (now := time.monotonic()) < end:
        samples = busy_round(server, viewers, min(end, now + ROUND_S), joins_per_minute)
        line(time.monotonic() - begin, viewers.started, samples[-1])
        viewers.reap(wait=True)
        rest = settle(server, first and first["froxel_device_memory_bytes"])
        if rest is None:
            return [], [], first
        # A busy device may still draw the last frame of the first round: what it holds is no measure.
        if first is None or rest["froxel_device_memory_bytes"] < first["froxel_device_memory_bytes"]:
            first = rest
        line(time.monotonic() - begin, viewers.started, rest)
        if now >= warm:
            busy += samples
            rests.append(rest)
    return busy, rests, first


def judge(busy, rests, before, after, device, viewers, scripts):
    """Lines that say what broke the rule."""
    first, last = thirds(rests, "process_resident_memory_bytes")
    heap = thirds(rests, "process_heap_used_bytes")
    minutes = (rests[-1]["at_s"] - rests[0]["at_s"]) / 60
    most = max(sample["process_resident_memory_bytes"] for sample in busy)
    print(
        f"resident memory at rest: {first / 1e6:.1f} to {last / 1e6:.1f} MB in {minutes:.1f} min; "
        f"with viewers at most {most / 1e6:.1f} MB"
    )
    print(f"of the heap at rest: {heap[0] / 1e6:.1f} to {heap[1] / 1e6:.1f} MB")
    print(f"descriptors: {before['process_open_fds']:.0f} before, {after['process_open_fds']:.0f} after")
    print(f"device memory: {device[0] / 1e6:.2f} MB at first, {device[1] / 1e6:.2f} MB at last")
    scrapes = sorted(sample["scrape_s"] for sample in busy)
    print(
        f"scrapes: {len(scrapes)}, median {scrapes[len(scrapes) // 2] * 1000:.1f} ms, "
        f"longest {scrapes[-1] * 1000:.1f} ms"
    )
    broken = []
    if len(rests) < 6:
        print("too few rounds at rest to judge what is allocated and resident: they differ from round to round")
    elif heap[1] - heap[0] >= (NOISY_RISE * heap[0] if "storm" in scripts else HEAP_RISE_BYTES):
        broken.append(f"what is allocated of the heap rose by {(heap[1] - heap[0]) / 1e6:.1f} MB")
    if len(rests) >= 6 and last - first >= NOISY_RISE * first:
        broken.append(f"resident memory rose by {(last - first) / 1e6:.1f} MB")
    if after["process_open_fds"] > before["process_open_fds"]:
        broken.append("descriptors were left open")
    if device[1] - device[0] > 0.01 * device[0]:
        broken.append("device memory is more than it was")
    if viewers.failures:
        broken.append(f"{len(viewers.failures)} viewers failed, the first: {viewers.failures[0]}")
    return broken


def main():
    arguments, serve_options = split_arguments()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("froxel")
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--joins-per-minute", type=float, default=50)
    parser.add_argument("--scripts", default=",".join(SCRIPTS))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args(arguments)
    if not (0.2 <= options.minutes <= 1440 and 1 <= options.joins_per_minute <= 600):
        parser.error("--minutes must be 0.2 to 1440, --joins-per-minute 1 to 600")
    scripts = options.scripts.split(",")
    if not set(scripts) <= set(SCRIPTS):
        parser.error(f"--scripts '{options.scripts}' must be a list of {', '.join(SCRIPTS)}")

    # However slow the device: viewers are let in.
    fixed = ["--min-fps", "0", "--resume-grace", str(GRACE_S), "--max-sessions", "32"]
    server = Server(options.froxel, *fixed, *serve_options)
    viewers = Viewers(options.froxel, server.url, scripts, options.seed)
    try:
        # One viewer of each kind first, so that what is opened or made once is there.
        for script in scripts:
            viewers.run(script, 2)
            viewers.reap(wait=True)
        before = settle(server)
        busy, rests, first = soak(server, viewers, options.minutes, options.joins_per_minute)
        for script in scripts:
            viewers.run(script, 2)
            viewers.reap(wait=True)
        after = settle(server, first and first["froxel_device_memory_bytes"])
    finally:
        code = server.stop()
    if before is None or after is None or not rests:
        print("failed: sessions or device memory stay though all viewers left")
        return 1
    device = [values["froxel_device_memory_bytes"] for values in (first, after)]
    broken = judge(busy, rests, before, after, device, viewers, scripts)
    if code != 0:
        broken.append(f"the server ended with {code}")
    print(f"{viewers.started} viewers")
    print("passed" if not broken else "failed: " + "; ".join(broken))
    return 1 if broken else 0


sys.exit(main())
