"""Draws pictures by light lists and by all lights, which must be equal bit for bit.

Usage: compare_lists.py FROXEL SCENE --camera CAMERA --light-box BOX [--random 50] [--lights 0,7,1000]
       [--stage compute,fragment] [--size 801x453] [--at-once 4] [--device gpu]

From CAMERA `forward_plus` is compared with `naive` for each number of lights; then from as many random cameras
inside BOX, each with its own number and places of lights, by a fixed seed. Prints a line for each pair that differs:
the options that draw it, how many pixels differ, and the first of them. Closes with "N equal, N differ".
Exit code 0: all equal; 1: some differ; 2: a picture could not be drawn.
"""

import argparse
import concurrent.futures
import random
import subprocess
import sys
import tempfile
from array import array
from pathlib import Path


def random_view(chance, box):
    """Options of a camera inside `box`, and of lights of one radius, so that lists have something to leave out."""
    eye = [chance.uniform(low, high) for low, high in zip(*box)]
    target = [chance.uniform(low, high) for low, high in zip(*box)]
    return [
        "--camera=" + ";".join((point(eye), point(target), f"{chance.uniform(40, 75):.0f}")),
        "--lights", str(chance.randrange(100, 4000)),
        "--light-radius", f"{chance.uniform(0.5, 3):.2f}",
        "--seed", str(chance.randrange(1000)),
    ]


def point(values):
    return ",".join(f"{value:.2f}" for value in values)


def radiance(path):
    """Width and the pixels of a colour .pfm, whose rows begin at the bottom."""
    kind, size, scale, pixels = path.read_bytes().split(b"\n", 3)
    if kind != b"PF" or float(scale) >= 0:
        raise ValueError(f"{path}: not a little-endian PF file")
    return int(size.split()[0]), array("f", pixels)


def difference(one, other):
    """In words; empty: none."""
    if one.read_bytes() == other.read_bytes():
        return ""
    width, ours = radiance(one)
    _, theirs = radiance(other)
    height = len(ours) // 3 // width
    apart = [i for i in range(len(ours) // 3) if ours[3 * i:3 * i + 3].tobytes() != theirs[3 * i:3 * i + 3].tobytes()]
    first = apart[0]
    values = " and ".join(
        "(" + ", ".join(f"{value:.9g}" for value in picture[3 * first:3 * first + 3]) + ")"
        for picture in (ours, theirs))
    at = f"({first % width}, {height - 1 - first // width})"
    return f"{len(apart)} pixels, the first at {at}: naive and forward_plus have {values}"


class Comparison:
    def __init__(self, arguments, folder):
        self.command = [arguments.froxel, "render", "--device", arguments.device, "--scene", arguments.scene]
        self.common = ["--look", "none", "--light-box=" + arguments.light_box, "--size", arguments.size]
        self.folder = Path(folder)

    def draw(self, options, renderer, name):
        out = self.folder / f"{name}.{renderer}.pfm"
        done = subprocess.run(
            [*self.command, *self.common, *options, "--warmup", "0", "--renderer", renderer, "--out", str(out)],
            capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(options)}: {done.stderr.strip()}")
        return out

    def compare(self, job):
        """What differs, with the options that show it."""
        number, options = job
        one, other = (self.draw(options, renderer, str(number)) for renderer in ("naive", "forward_plus"))
        found = difference(one, other)
        one.unlink()
        other.unlink()
        return f"{' '.join(options + self.common)}: {found}" if found else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("froxel")
    parser.add_argument("scene")
    parser.add_argument("--camera", required=True)
    parser.add_argument("--light-box", required=True)
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--lights", default="0,7,1000")
    parser.add_argument("--stage", default="compute,fragment")
    parser.add_argument("--size", default="801x453")
    parser.add_argument("--at-once", type=int, default=4)
    parser.add_argument("--device", default="gpu")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    box = [[float(x) for x in corner.split(",")] for corner in arguments.light_box.split(";")]

    chance = random.Random(arguments.seed)
    views = [["--camera=" + arguments.camera, "--lights", count] for count in arguments.lights.split(",")]
    views += [random_view(chance, box) for _ in range(arguments.random)]
    jobs = [view + ["--lighting", stage] for view in views for stage in arguments.stage.split(",")]
    differ = 0
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(arguments.at_once) as pool:
        try:
            for line in pool.map(Comparison(arguments, folder).compare, enumerate(jobs)):
                if line:
                    differ += 1
                    print(line, flush=True)
        except RuntimeError as error:
            pool.shutdown(cancel_futures=True)
            print(f"compare_lists: {error}", file=sys.stderr)
            return 2
    print(f"{len(jobs) - differ} equal, {differ} differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
