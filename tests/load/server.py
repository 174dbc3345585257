"""A `froxel serve` of its own ports, and what its /metrics say: for the tools of this folder."""

import re
import shutil
import subprocess
import sys
import time
import urllib.request


def split_arguments():
    """What the command line has for the tool itself, and after "--" for froxel serve."""
    own, serve = sys.argv[1:], []
    if "--" in own:
        at = own.index("--")
        own, serve = own[:at], own[at + 1 :]
    return own, serve


def write_halls(folder, froxel):
    """Four scenes that take a second to read: the built-in hall, by the names 0 to 3. The first one's path."""
    hall = folder / "0.glb"
    subprocess.run([froxel, "scene", "--out", hall, "--log-level", "error"], check=True, stdout=subprocess.DEVNULL)
    for name in "123":
        shutil.copy(hall, folder / f"{name}.glb")
    return hall


class Server:
    """Runs until stop(), or the end of a `with`."""

    def __init__(self, froxel, *options):
        # What figures of earlier versions were taken with.
        command = [froxel, "serve", "--port", "0", "--admin-bind", "127.0.0.1:0", "--look", "rainbow"]
        command += ["--log-level", "error", *options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.url = self.process.stdout.readline().strip()
        self.metrics_url = self.process.stdout.readline().strip()
        if not self.metrics_url:
            sys.exit(f"the server did not start: {' '.join(command)}")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        """Its exit code."""
        self.process.terminate()
        return self.process.wait(60)

    def scrape(self):
        """What /metrics says."""
        with urllib.request.urlopen(self.metrics_url, timeout=5) as answer:
            return answer.read().decode()

    def of_device(self):
        """Its memory by purpose, in words."""
        found = re.findall(r'^froxel_device_memory_bytes{purpose="([^"]*)"} (\S+)$', self.scrape(), re.MULTILINE)
        return ", ".join(f"{purpose} {float(value) / 1e6:.2f} MB" for purpose, value in found)

    def sample(self):
        """Every metric's value, summed over its labels; "at_s" and "scrape_s" besides."""
        start = time.monotonic()
        text = self.scrape()
        values = {}
        for name, value in re.findall(r"^([a-z_]+)(?:\{[^}]*\})? (\S+)$", text, re.MULTILINE):
            values[name] = values.get(name, 0) + float(value)
        values["at_s"] = start
        values["scrape_s"] = time.monotonic() - start
        return values
