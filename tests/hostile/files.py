"""Files of scenes that ask for much, read under a limit of memory.

Usage: files.py FROXEL [--only NAME,...]

Each is small, or is quick to write, and says that it holds far more. `froxel info --scenes` must read it within 30 s,
with the address space bounded (ulimit -v) and, where the host lets this process make one, in a control group, and tell
of it in one line. A signal, a crash or a kill for memory fails. Exit code 0: all did; 1: one did not.
"""

import argparse
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

ADDRESS_SPACE = 800 << 20
GROUP_BYTES = 512 << 20
SECONDS = 30
FILES = {}


def file(make):
    """Registers `make(folder)`, which writes a file there and gives its path."""
    FILES[make.__name__] = make
    return make


def gltf(folder, **members):
    path = folder / "scene.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, **members}))
    return path


def triangle(count=3, **more):
    """Members of a scene whose mesh has `count` vertices without data: zeros, as the specification has it."""
    return {"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "accessors": [{"componentType": 5126, "type": "VEC3", "count": count}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], **more}


def placed(nodes):
    """Members that place all of these nodes."""
    return {"nodes": nodes, "scenes": [{"nodes": list(range(len(nodes)))}]}


@file
def cameras_of_one_name(folder):
    """310 kB with 8,000 cameras of one name."""
    lens = {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}
    return gltf(folder, cameras=[lens], **placed([{"camera": 0, "name": "c"}] * 8000))


@file
def meshopt_of_4_gib(folder):
    """698 bytes with a view that claims 4 GiB."""
    (folder / "a.bin").write_bytes(b"\xa0" + bytes(35))
    compressed = {"buffer": 0, "byteOffset": 0, "byteLength": 36, "byteStride": 256, "count": 16777215,
                  "mode": "ATTRIBUTES"}
    views = [{"buffer": 0, "byteLength": 36, "extensions": {"EXT_meshopt_compression": compressed}}]
    members = triangle(16777215, extensionsUsed=["EXT_meshopt_compression"], bufferViews=views,
                       buffers=[{"uri": "a.bin", "byteLength": 36}])
    members["accessors"][0]["bufferView"] = 0
    return gltf(folder, **members)


@file
def vertices_without_data(folder):
    """As many vertices as a scene may have, of zeros."""
    return gltf(folder, **triangle(1 << 26))


@file
def flat_corners(folder):
    """Three vertices and 200 million indices, of which each becomes a vertex."""
    members = triangle()
    members["accessors"].append({"componentType": 5125, "type": "SCALAR", "count": 3 << 26})
    members["meshes"][0]["primitives"][0]["indices"] = 1
    return gltf(folder, **members)


@file
def json_of_empty_arrays(folder):
    """15 MB of "[[],[],...": a tree of 5 million values."""
    path = folder / "scene.gltf"
    path.write_text('{"asset":{"version":"2.0"},"extras":[' + "[]," * 5_000_000 + "[]]}")
    return path


@file
def json_of_nested_arrays(folder):
    """10 MB of "[[[[...": as deep as it is long."""
    path = folder / "scene.gltf"
    path.write_text('{"asset":{"version":"2.0"},"extras":' + "[" * 10_000_000)
    return path


@file
def materials_of_nothing(folder):
    """A million materials of three bytes each."""
    path = folder / "scene.gltf"
    path.write_text('{"asset":{"version":"2.0"},"materials":[' + "{}," * 1_000_000 + "{}]}")
    return path


@file
def file_with_a_hole(folder):
    """A GLB of 3 GiB that takes no space on the disk."""
    text = json.dumps({"asset": {"version": "2.0"}}).encode()
    text += b" " * (-len(text) % 4)
    size = 3 << 30
    path = folder / "scene.glb"
    with path.open("wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, size))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text)
        out.write(struct.pack("<I4s", size - 28 - len(text), b"BIN\0"))
        out.truncate(size)
    return path


@file
def targets_times_nodes(folder):
    """Ten thousand nodes that show a mesh with ten thousand targets."""
    members = triangle()
    members["meshes"][0]["primitives"][0]["targets"] = [{} for _ in range(10_000)]
    return gltf(folder, **{**members, **placed([{"mesh": 0}] * 10_000)})


@file
def joints_times_nodes(folder):
    """Ten thousand nodes that follow a skin with ten thousand joints."""
    members = triangle(skins=[{"joints": [0] * 10_000}])
    return gltf(folder, **{**members, **placed([{"mesh": 0, "skin": 0}] * 10_000)})


@file
def primitives_times_nodes(folder):
    """Five thousand nodes that show a mesh with five thousand primitives."""
    members = triangle()
    members["meshes"][0]["primitives"] *= 5000
    return gltf(folder, **{**members, **placed([{"mesh": 0}] * 5000)})


@file
def long_name_times_instances(folder):
    """A name of 50 MB on a node with a million instances."""
    members = triangle(extensionsUsed=["EXT_mesh_gpu_instancing"])
    members["accessors"].append({"componentType": 5126, "type": "VEC3", "count": 1 << 20})
    members["nodes"] = [{"mesh": 0, "name": "n" * 50_000_000,
                         "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}]
    return gltf(folder, **members)


@file
def many_names(folder):
    """A hundred thousand animations with names of a kilobyte."""
    animations = [{"name": f"{number:01000}", "channels": [], "samplers": []} for number in range(100_000)]
    return gltf(folder, **triangle(animations=animations))


@file
def image_of_16384(folder):
    """A PNG of 57 bytes that claims 16384x16384 pixels."""
    header = struct.pack(">IIBBBBB", 16384, 16384, 8, 2, 0, 0, 0)
    chunk = b"IHDR" + header
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", len(header)) + chunk + struct.pack(">I", zlib.crc32(chunk))
    png += struct.pack(">I", 0) + b"IDAT" + struct.pack(">I", zlib.crc32(b"IDAT"))
    (folder / "a.png").write_bytes(png)
    material = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
    members = triangle(images=[{"uri": "a.png"}], textures=[{"source": 0}], materials=[material])
    members["accessors"].append({"componentType": 5126, "type": "VEC2", "count": 3})
    members["meshes"][0]["primitives"][0].update(material=0)
    members["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 1
    return gltf(folder, **members)


def group():
    """(folder, file of its limit) of a control group, of version 2 or 1, or None where none can be made."""
    for root, limit in (("/sys/fs/cgroup", "memory.max"), ("/sys/fs/cgroup/memory", "memory.limit_in_bytes")):
        folder = Path(root) / "froxel_hostile"
        if not (Path(root) / "cgroup.procs").exists():
            continue
        try:
            folder.mkdir(exist_ok=True)
            if (folder / limit).exists():
                (folder / limit).write_text(str(GROUP_BYTES))
                return folder
        except OSError:
            pass
    return None


def read(froxel, folder, limited):
    """(exit code or None, what it wrote, seconds)"""
    begin = time.monotonic()
    try:
        done = subprocess.run([froxel, "info", "--scenes", folder, "--log-level", "error"], preexec_fn=limited,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS, text=True)
        return done.returncode, done.stdout.strip().splitlines(), time.monotonic() - begin
    except subprocess.TimeoutExpired:
        return None, [], SECONDS


def fault(code, lines):
    if code is None:
        return f"it took more than {SECONDS} s"
    if code != 0 or len(lines) != 2 or not lines[1].startswith("scene.gl"):
        return f"it ended with {code} and {len(lines)} lines: {' '.join(lines)[-300:]}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("froxel")
    parser.add_argument("--only")
    options = parser.parse_args()
    chosen = options.only.split(",") if options.only else list(FILES)
    in_group = group()
    ways = {"ulimit -v": lambda: resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))}
    if in_group:
        ways["control group"] = lambda: (in_group / "cgroup.procs").write_text(str(os.getpid()))
    else:
        print("no control group can be made here: that way is left out")
    failed = 0
    for name in chosen:
        with tempfile.TemporaryDirectory() as folder:
            path = FILES[name](Path(folder))
            for way, limited in ways.items():
                code, lines, seconds = read(options.froxel, folder, limited)
                wrong = fault(code, lines)
                failed += wrong is not None
                print(f"{name:<26}{way:<15}{path.stat().st_size:>14,} bytes {seconds:6.1f} s  "
                      f"{wrong or lines[1][:200]}", flush=True)
    if in_group:
        in_group.rmdir()
    print("all hold" if not failed else f"{failed} do not hold")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
