"""Measures how many viewers a GPU serves, and what one picture costs the host's threads.

Usage: viewers_a_gpu.py FROXEL [--base FROXEL] [--places host,device] [--rows rest150,orbit50,...]
                        [--seconds 8] [--json FILE] [-- OPTIONS OF froxel serve]

Starts a server for each place where JPEGs are made, and for --base one of an earlier version, and plays on each:

  rest150: 150 viewers at rest while the lights move
  orbit1, orbit50, orbit80: so many viewers, each a private orbit

Prints for each row the frame rates, intervals and latencies; then the processor time of the server's threads for each
picture that a viewer received, by the threads' names, and the cores that the viewers themselves used.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from server import Server, split_arguments

ROWS = {"rest150": ("idle", 150), "orbit1": ("orbit", 1), "orbit50": ("orbit", 50), "orbit80": ("orbit", 80)}
TICK_MS = 1e3 / os.sysconf("SC_CLK_TCK")


def thread_times(pid):
    """Milliseconds of processor time by thread name."""
    times = {}
    for task in Path(f"/proc/{pid}/task").iterdir():
        try:
            name, rest = re.match(r"\d+ \((.*)\) . (.*)", (task / "stat").read_text()).groups()
        except FileNotFoundError:
            continue  # has ended
        fields = rest.split()
        times[name] = times.get(name, 0) + (int(fields[10]) + int(fields[11])) * TICK_MS
    return times


def measure(froxel, server, script, viewers, seconds):
    """The report of `froxel load`, and the server's thread times for each picture."""
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        command = [froxel, "load", server.url, "--viewers", str(viewers), "--seconds", str(seconds)]
        command += ["--script", script, "--json", report.name]
        before, drawn = thread_times(server.process.pid), server.sample()
        said = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        after, now = thread_times(server.process.pid), server.sample()
        if said.returncode != 0:
            sys.exit(f"a viewer failed: {said.stdout}")
        pictures = now["froxel_frames_sent_total"] - drawn["froxel_frames_sent_total"]
        each = {name: (time - before.get(name, 0)) / pictures for name, time in after.items()}
        return json.load(report), each


def told(name, report, threads):
    rates = [viewer["frames_per_s"] for viewer in report["each"]]
    every, interval = report["all"], report["all"]["interval_ms"]
    stall = max(viewer["stall_ms"] for viewer in report["each"])
    stages = " ".join(f"{stage} {times['median']:.2f}" for stage, times in every["stages_ms"].items() if times)
    latency = every["latency_ms"]
    lines = [
        f"{name}: {sum(rates):.0f} frames/s, each {sum(rates) / len(rates):.1f}, least {min(rates):.1f}; "
        f"interval p95 {interval['p95']:.1f} p99 {interval['p99']:.1f} ms, longest stall {stall:.0f} ms"
    ]
    if latency and latency.get("median"):
        lines[0] += f"; latency p50 {latency['median']:.2f} p95 {latency['p95']:.2f} ms"
    most = sorted(((time, thread) for thread, time in threads.items() if time >= 0.0005), reverse=True)
    lines.append(f"  median ms: {stages}")
    lines.append(
        f"  thread ms a picture: {sum(threads.values()):.3f} ("
        + ", ".join(f"{thread} {time:.3f}" for time, thread in most)
        + f"); viewers: {report.get('busy_cores', float('nan')):.1f} cores"
    )
    return "\n".join(lines)


def main():
    own, serve = split_arguments()
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("froxel")
    parser.add_argument("--base")
    parser.add_argument("--places", default="host,device")
    parser.add_argument("--rows", default=",".join(ROWS))
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(own)
    servers = [(place, options.froxel, ["--jpeg-encoder", place]) for place in options.places.split(",") if place]
    if options.base:
        servers.insert(0, ("base", options.base, []))
    results = {}
    for name, binary, more in servers:
        with Server(binary, "--max-sessions", "256", "--min-fps", "0", *serve, *more) as server:
            measure(options.froxel, server, "orbit", 4, 2)  # pipelines are compiled, clocks are up
            for row in options.rows.split(","):
                script, viewers = ROWS[row]
                report, threads = measure(options.froxel, server, script, viewers, options.seconds)
                results[f"{name} {row}"] = {"report": report, "thread_ms_a_picture": threads}
                print(told(f"{name} {row}", report, threads), flush=True)
    if options.json:
        options.json.write_text(json.dumps(results))


if __name__ == "__main__":
    main()
