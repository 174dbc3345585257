"""Writes a GLB that is as large as wanted: a square for each of its images, which are noise.

Usage: large_scene.py OUT.glb IMAGES [--side 4096] [--seed 1]

An image of 4096x4096 takes 48 MiB of the file, and 85 MiB of the device with its smaller levels.
"""

import argparse
import json
import random
import struct
import zlib


def png(side, random_bytes):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + random_bytes(side * 3) for _ in range(side))
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b"")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("out")
    parser.add_argument("images", type=int)
    parser.add_argument("--side", type=int, default=4096)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    noise = random.Random(options.seed)
    corners = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0) + struct.pack("<12f", *([0, 0, 1] * 4))
    corners += struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    parts = [corners]
    views = [
        {"buffer": 0, "byteOffset": 0, "byteLength": 48},
        {"buffer": 0, "byteOffset": 48, "byteLength": 48},
        {"buffer": 0, "byteOffset": 96, "byteLength": 32},
        {"buffer": 0, "byteOffset": 128, "byteLength": 12},
    ]
    for _ in range(options.images):
        parts.append(b"\0" * (-sum(map(len, parts)) % 4))
        picture = png(options.side, noise.randbytes)
        views.append({"buffer": 0, "byteOffset": sum(map(len, parts)), "byteLength": len(picture)})
        parts.append(picture)
    body = b"".join(parts)
    body += b"\0" * (-len(body) % 4)
    count = range(options.images)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(count)}],
        "nodes": [{"mesh": i, "translation": [1.1 * (i % 4), 1.1 * (i // 4), 0]} for i in count],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": i}]}
            for i in count
        ],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in count],
        "textures": [{"source": i} for i in count],
        "images": [{"bufferView": 4 + i, "mimeType": "image/png"} for i in count],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(options.out, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(body)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(body), b"BIN\0") + body)


if __name__ == "__main__":
    main()
