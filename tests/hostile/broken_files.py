"""Scene files of six formats that are broken in some way: cut short, with changed bytes, or lying about their size."""
import io
import itertools
import json
import random
import struct
import zipfile

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
CORNER_BYTES = b"".join(struct.pack("<3f", *corner) for corner in CORNERS)


def gltf(**changes):
    """A triangle with its buffer inside."""
    text = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]}
    return json.dumps(text | changes).encode()


def glb(text, binary=CORNER_BYTES):
    text += b" " * (-len(text) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def stl(count=1):
    return b"x" * 80 + struct.pack("<I", count) + b"\0" * 12 + CORNER_BYTES + b"\0\0"


PLY = (b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       b"element face 1\nproperty list uint int vertex_indices\nend_header\n" + CORNER_BYTES + struct.pack("<4I", 3, 0, 1, 2))
OBJ = b"# a triangle\nmtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ns 1\nf 1/1/1 2/1/1 3/1/1\n"
STL_TEXT = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"

MODEL = ('<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" '
         'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>%s</resources><build>%s</build></model>')
TETRAHEDRON = ('<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>'
               '<vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>'
               '<triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles>'
               '</mesh></object>')
ITEM = '<item objectid="1"/>'
SCHEMAS = "http://schemas.openxmlformats.org/package/2006/"


def threemf(model=MODEL % (TETRAHEDRON, ITEM)):
    package = io.BytesIO()
    with zipfile.ZipFile(package, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", f'<?xml version="1.0"?><Types xmlns="{SCHEMAS}content-types"><Default '
                         f'Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default '
                         'Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        archive.writestr("_rels/.rels", f'<?xml version="1.0"?><Relationships xmlns="{SCHEMAS}relationships"><Relationship '
                         'Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
                         '</Relationships>')
        archive.writestr("3D/3dmodel.model", model)
    return package.getvalue()


def components(levels):
    """Each object is twice the one before."""
    objects = "".join(f'<object id="{n}" type="model"><components><component objectid="{n - 1}"/><component '
                      f'objectid="{n - 1}"/></components></object>' for n in range(2, levels))
    return MODEL % (TETRAHEDRON + objects, f'<item objectid="{levels - 1}"/>')


WHOLE = {"gltf": gltf(buffers=[{"byteLength": 36, "uri": "data:;base64," + "A" * 48}]), "glb": glb(gltf()), "obj": OBJ, "ply": PLY,
         "stl": stl(), "stl text": STL_TEXT, "3mf": threemf()}
LIES = {
    "glb of 4 GiB": glb(gltf())[:8] + b"\xff" * 4 + glb(gltf())[12:],
    "glb chunk of 4 GiB": glb(gltf())[:12] + b"\xff\xff\xff\xff" + glb(gltf())[16:],
    "gltf of two thousand million vertices": gltf(accessors=[{"componentType": 5126, "count": 2_000_000_000, "type": "VEC3"}]),
    "gltf that reads a file": gltf(buffers=[{"uri": "/etc/passwd", "byteLength": 36}]),
    "gltf of nested arrays": b'{"a":' * 100_000,
    "gltf whose nodes are their own children": gltf(nodes=[{"mesh": 0, "children": [0]}]),
    "obj of a vertex that is not there": OBJ + b"f 1 2 4000000000\n",
    "obj of a vertex before the first": OBJ + b"f -1 -2 -9\n",
    "obj that reads a file": OBJ.replace(b"gone.mtl", b"../../../../etc/passwd"),
    "obj of a polygon with many corners": OBJ + b"f " + b"1 2 3 " * 5000 + b"\n",
    "obj of a heap of triangles": OBJ + b"f 1 2 3\n" * 50_000,
    "obj of numbers that are none": OBJ.replace(b"1 0 0", b"nan inf 1e999"),
    "obj of one long line": b"# " + b"x" * 1_000_000,
    "ply of many vertices": PLY.replace(b"vertex 3", b"vertex 18446744073709551615"),
    "ply of a long list": PLY[:-16] + struct.pack("<4I", 0xFFFFFFFF, 0, 1, 2),
    "ply of elements without properties": PLY.replace(b"element face 1", b"element none 18446744073709551615\nelement face 1"),
    "ply without an end": b"ply\n" + b"comment x\n" * 100_000,
    "stl of four thousand million triangles": stl(0xFFFFFFFF),
    "stl of facets without an end": b"solid\n" + b"facet normal 0 0 1 outer loop " * 10_000,
    "3mf that unpacks to 200 MB": threemf(MODEL % (TETRAHEDRON.replace("<vertices>", "<vertices>" + '<vertex x="0" y="0" z="0"/>' * 8_000_000), ITEM)),
    "3mf of components that multiply": threemf(components(60)),
    "3mf of an entity that multiplies": threemf('<!DOCTYPE a [<!ENTITY b "' + "x" * 10_000 + '">]><model>' + "&b;" * 10_000 + "</model>"),
    "3mf of no triangles": threemf(MODEL % ("", "")),
    "zip of something else": threemf("").replace(b"3dmodel.model", b"another.model"),
}


def broken_files(count=200):
    """[(name, bytes)], always the same ones."""
    dice = random.Random(67)
    files = list(LIES.items())
    for kind in itertools.cycle(WHOLE):
        if len(files) == count:
            return files
        body = bytearray(WHOLE[kind])
        if dice.random() < 0.4:
            size = dice.randrange(1, len(body))
            files.append((f"{kind} cut to {size} bytes", bytes(body[:size])))
            continue
        for _ in range(dice.choice((1, 1, 4, 16))):
            body[dice.randrange(4, len(body))] = dice.choice((0, 1, 0x2D, 0x39, 0x7F, 0x80, 0xFF, dice.randrange(256)))
        files.append((f"{kind} with changed bytes", bytes(body)))
