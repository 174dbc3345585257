"""Measures the stream on this machine by `froxel load`, and says which aims are met.

Usage: figures.py FROXEL OUT gpu|cpu [--only NAME,...] [--relay FROXEL_RELAY] [-- OPTIONS OF froxel serve]

Prints a line for each row and writes OUT/load_NAME.json. gpu: one viewer, one by VP9, 16, 50 and 100
private ones, 200 in a room, one at rest. cpu: one viewer, one on a link of half of what that one needs and
the link's recovery, one beside another on a fast and on a slow link, one at rest; with links of the relay
(cmake --build build/test --target froxel_relay). The machine should do nothing else: viewers run on it too.
Exit code 0: every aim is met; 1: one is not, or a viewer failed.
"""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

from server import Server, split_arguments

ROWS = {
    "gpu": ["v1", "v1vp9", "v16", "v50", "v100_target30", "room200", "rest"],
    "cpu": ["v1", "half_link", "recovery", "beside_fast", "beside_slow", "rest"],
}
NEEDS = {"half_link": "v1", "recovery": "v1", "beside_slow": "beside_fast"}
SLOW_KBIT = 1500  # of the viewer that another is beside
FAST_KBIT = 1_000_000
DELAY_MS = 10


class Link:
    """A relay to a server; of its own rate each way."""

    def __init__(self, relay, server, kbit_per_s):
        command = [relay, "--to", server.url.split("/")[2], "--kbit-per-s", f"{kbit_per_s:.0f}"]
        command += ["--delay-ms", str(DELAY_MS), "--buffer-kb", "32"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)
        self.url = f"http://{self.process.stdout.readline().strip()}/"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait(10)

    def set_rate(self, kbit_per_s):
        self.process.stdin.write(f"{kbit_per_s:.0f}\n")
        self.process.stdin.flush()


class Figures:
    def __init__(self, froxel, relay, out, serve):
        self.froxel, self.relay, self.out, self.serve = froxel, relay, out, serve
        self.results, self.missed = {}, 0

    def say(self, name, text, *aims):
        """aims: (what, value, bound), missed where the value is above its bound."""
        missed = [f"{what} {value:.4g}, aim {bound:.4g}" for what, value, bound in aims if value > bound]
        self.missed += len(missed)
        verdict = f"missed: {', '.join(missed)}" if missed else "met" if aims else "no aim"
        print(f"{name}: {text}: {verdict}", flush=True)

    def server(self, *options):
        return Server(self.froxel, *self.serve, "--max-sessions", "256", "--min-fps", "0", *options)

    def viewers(self, url, *options, script="orbit", seconds):
        """Started, not waited for."""
        command = [self.froxel, "load", url, "--script", script, "--seconds", str(seconds), *options]
        pipe = subprocess.PIPE
        return subprocess.Popen(command, stdout=pipe, stderr=subprocess.STDOUT, text=True)

    def load(self, name, url, *options, seconds=10):
        """What viewers measured, also kept as a file."""
        file = self.out / f"load_{name}.json"
        run = self.viewers(url, *options, "--json", str(file), seconds=seconds)
        said, _ = run.communicate()
        if run.returncode != 0:
            sys.exit(f"{name}: {said.strip().splitlines()[-1]}")
        self.results[name] = json.loads(file.read_text())
        return self.results[name]

    def row(self, name, *options, serve=(), seconds=10):
        with self.server(*serve) as server:
            return self.load(name, server.url, *options, seconds=seconds)

    # A GPU

    def v1(self, name):
        result = self.row(name)
        self.say(name, words(result), ("median, ms", median(result), 6), ("p95, ms", p95(result), 10))

    def v1vp9(self, name):
        self.say(name, words(self.row(name, "--codec", "vp9")))

    def v16(self, name):
        result = self.row(name, "--viewers", "16", "--ramp", "1")
        self.say(name, words(result), at_least(60, result))

    def v50(self, name):
        result = self.row(name, "--viewers", "50", "--ramp", "2")
        self.say(name, words(result), at_least(30, result), ("p95, ms", p95(result), 50))

    def v100_target30(self, name):
        options = ("--viewers", "100", "--ramp", "5")
        result = self.row(name, *options, serve=("--target-fps", "30"), seconds=25)
        self.say(name, words(result), at_least(30, result), ("p95, ms", p95(result), 50))

    def room200(self, name):
        result = self.row(name, "--viewers", "200", "--ramp", "3", "--room", "hall")
        self.say(name, words(result), at_least(60, result))

    # A CPU device and links

    def cpu_v1(self, name):
        self.say(name, words(self.row(name, seconds=12)))

    def half_kbit(self):
        return self.results["v1"]["all"]["received_bytes_per_s"] * 8e-3 / 2

    def half_link(self, name):
        with self.server() as server, Link(self.relay, server, self.half_kbit()) as link:
            result = self.load(name, link.url, seconds=60)
        age = ("age p99, ms", result["all"]["age_ms"]["p99"], 250)
        self.say(name, f"{self.half_kbit():.0f} kbit/s, {words(result)}", age)

    def recovery(self, name):
        with self.server() as server, Link(self.relay, server, FAST_KBIT) as link:
            run = self.viewers(link.url, seconds=30)
            time.sleep(6)
            asked = shown(server)
            link.set_rate(self.half_kbit())
            time.sleep(15)
            slow = shown(server)
            link.set_rate(FAST_KBIT)
            begin = time.monotonic()
            while not whole(shown(server, 0.2), asked) and time.monotonic() < begin + 8:
                pass
            seconds = time.monotonic() - begin
            run.communicate()
        if not (asked and slow):
            sys.exit(f"{name}: no picture came for a second")
        text = f"quality {asked[0]:.0f} at {asked[1]:.2f} of each side, {slow[0]:.1f} at {slow[1]:.2f}"
        self.say(name, f"{text}, whole again in {seconds:.1f} s", ("s", seconds, 3))

    def beside(self, name, kbit_per_s):
        with self.server() as server, Link(self.relay, server, kbit_per_s) as link:
            other = self.viewers(link.url, seconds=24)
            time.sleep(6)
            result = self.load(name, server.url, seconds=14)
            other.communicate()
        return result

    def beside_fast(self, name):
        self.say(name, words(self.beside(name, FAST_KBIT)))

    def beside_slow(self, name):
        result = self.beside(name, SLOW_KBIT)
        most = 1.1 * p95(self.results["beside_fast"])
        self.say(name, f"{SLOW_KBIT} kbit/s, {words(result)}", ("p95, ms", p95(result), most))

    # Either

    def rest(self, name, seconds=30):
        """What a viewer costs while nothing moves and its picture is refined, above what the server
        takes without viewers: a driver's own threads do not rest."""
        with self.server("--no-animate") as server:
            run = self.viewers(server.url, script="idle", seconds=seconds + 12)
            time.sleep(8)
            frames, sent, cpu = rates(server, seconds)
            there = server.sample()["froxel_viewers"] == 1
            run.communicate()
            time.sleep(3)
            _, _, alone = rates(server, seconds)
        if not there or run.returncode != 0:
            sys.exit(f"{name}: the viewer was not there")
        text = f"{frames:.2f} frames/s, {sent:.1f} bytes/s, {(cpu - alone) * 100:.3f} % of a core"
        text += f" above the {alone * 100:.3f} % without a viewer"
        aims = ("frames/s", frames, 0), ("bytes/s", sent, 200), ("%", (cpu - alone) * 100, 0.1)
        self.say(name, text, *aims)


def median(result):
    return result["all"]["latency_ms"]["median"]


def p95(result):
    return result["all"]["latency_ms"]["p95"]


def slowest(result):
    return min(viewer["frames_per_s"] for viewer in result["each"])


def at_least(frames_per_s, result):
    """A frame less than the rate's is the counting's: where the measured time begins and ends."""
    slack = 1 / result["measured_s"]
    slow = slowest(result)
    return ("ms a frame", 1000 / slow if slow else float("inf"), 1000 / (frames_per_s - slack))


def words(result):
    every = result["all"]
    return (
        f"{every['frames_per_s'] / result['viewers']:.1f} frames/s each, none below {slowest(result):.1f}, "
        f"latency {median(result):.1f} / {p95(result):.1f} ms, age p99 {every['age_ms']['p99']:.1f} ms, "
        f"{every['received_bytes_per_s'] * 8e-6:.1f} Mbit/s"
    )


def growth(server, seconds):
    """By how much each metric grows in the next seconds."""
    before = server.sample()
    time.sleep(seconds)
    return {name: value - before.get(name, 0) for name, value in server.sample().items()}


def rates(server, seconds):
    """Frames, bytes and seconds of processor time, of each second of the next ones."""
    names = ("froxel_frames_rendered_total", "froxel_sent_bytes_total", "process_cpu_seconds_total")
    more = growth(server, seconds)
    return [more[name] / more["at_s"] for name in names]


def shown(server, seconds=1.0):
    """Mean quality and scale of the pictures sent in the next seconds; None where there was none."""
    more = growth(server, seconds)
    frames = more["froxel_frame_quality_count"]
    names = ("froxel_frame_quality_sum", "froxel_frame_scale_sum")
    return tuple(more[name] / frames for name in names) if frames else None


def whole(now, asked):
    """Whether quality and scale are those of before; a little less where one frame was not."""
    return now and asked and now[0] > asked[0] - 1 and now[1] > asked[1] - 0.02


def main():
    arguments, serve = split_arguments()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("froxel")
    parser.add_argument("out", type=Path)
    parser.add_argument("device", choices=ROWS)
    parser.add_argument("--only", help="rows, comma-separated")
    parser.add_argument("--relay", help="froxel_relay, wanted by links")
    options = parser.parse_args(arguments)
    rows = options.only.split(",") if options.only else ROWS[options.device]
    if not set(rows) <= set(ROWS[options.device]):
        parser.error(f"--only '{options.only}' must be a list of {', '.join(ROWS[options.device])}")
    for row, needed in NEEDS.items():
        if row in rows and needed not in rows[: rows.index(row)]:
            parser.error(f"--only '{options.only}' must have {needed} before {row}")
    if options.device == "cpu" and not options.relay:
        parser.error("cpu wants --relay FROXEL_RELAY")
    options.out.mkdir(parents=True, exist_ok=True)

    figures = Figures(options.froxel, options.relay, options.out, ["--device", options.device, *serve])
    for name in rows:
        of_cpu = getattr(figures, f"{options.device}_{name}", None)
        (of_cpu or getattr(figures, name))(name)
    return 1 if figures.missed else 0


sys.exit(main())
