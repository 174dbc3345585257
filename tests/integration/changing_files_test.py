#!/usr/bin/env python3
"""Files and folders that change under a server: changing_files_test.py PATH_OF_FROXEL.

One server with a folder of scenes that is found by a link; everything is awaited, nothing timed.
"""

import base64
import json
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request
from pathlib import Path

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
TRIANGLE = Path(__file__).resolve().parents[1] / "deploy" / "triangle.gltf"
PATIENCE_S = 100


def textured():
    """The triangle, unlit, with all corners at the middle of texture.png."""
    scene = json.loads(TRIANGLE.read_text(encoding="utf-8"))
    middles = base64.b64encode(struct.pack("<6f", *[0.5] * 6)).decode()
    scene["buffers"].append({"byteLength": 24, "uri": "data:application/octet-stream;base64," + middles})
    scene["bufferViews"].append({"buffer": 1, "byteLength": 24})
    scene["accessors"].append({"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"})
    scene["images"] = [{"uri": "textures/../texture.png"}]
    scene["textures"] = [{"source": 0}]
    scene["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                           "extensions": {"KHR_materials_unlit": {}}}]
    scene["extensionsUsed"] = ["KHR_materials_unlit"]
    primitive = scene["meshes"][0]["primitives"][0]
    primitive["material"] = 0
    primitive["attributes"]["TEXCOORD_0"] = 1
    return json.dumps(scene)


class ChangingFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "first").mkdir()
        (cls.folder / "current").symlink_to("first")
        (cls.folder / "first" / "scene.gltf").write_text(textured(), encoding="utf-8")
        cls.server = subprocess.Popen(
            [FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind", "none", "--min-fps", "0",
             "--scenes", cls.folder / "current"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        cls.addClassCleanup(cls.server.wait)
        cls.addClassCleanup(cls.server.kill)
        cls.addClassCleanup(cls.server.stdout.close)
        cls.url = cls.server.stdout.readline().strip()

    def get(self, path, etag=None):
        """Status, tag and bytes."""
        request = urllib.request.Request(self.url + path, headers={"If-None-Match": etag} if etag else {})
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
                return answer.status, answer.headers["ETag"], answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.headers["ETag"], error.read()

    def scenes(self):
        """By path, all that lie in the folder."""
        listed = json.loads(self.get("api/v1/scenes")[2])["scenes"]
        return {scene["path"]: scene for scene in listed if scene["path"]}

    def until(self, what, probe):
        end = time.monotonic() + PATIENCE_S
        while not (found := probe()):
            if time.monotonic() > end:
                self.fail(f"waited in vain for {what}")
            time.sleep(0.1)
        return found

    def paint(self, color):
        """Writes the texture: a still of the empty background."""
        status, _, picture = self.get("render?size=16x16&format=png&lights=0&eye=0,900,0&target=0,901,0&up=0,0,1"
                                      f"&environment_background=0&background_gradient=0&background_color={color}")
        self.assertEqual(status, 200, picture[:200])
        new = self.folder / "first" / "new.png"
        new.write_bytes(picture)
        new.rename(self.folder / "first" / "texture.png")

    def test_1_texture_is_replaced(self):
        self.paint("1,0,0")
        before = self.until("the scene", lambda: self.scenes().get("scene.gltf"))
        still = f"render?size=64x48&lights=0&format=png&scene={before['id']}"
        status, etag, picture = self.get(still)
        self.assertEqual(status, 200, picture[:200])
        self.assertEqual(self.get(still, etag)[0], 304)
        self.paint("0,1,0")
        after = self.until("another address of the thumbnail",
                           lambda: (now := self.scenes()["scene.gltf"])["thumb"] != before["thumb"] and now)
        self.assertEqual(after["id"], before["id"])
        status, _, changed = self.get(still, etag)
        self.assertEqual(status, 200)
        self.assertNotEqual(changed, picture)

    def test_2_folder_is_moved_away_and_made_again(self):
        (self.folder / "first").rename(self.folder / "away")
        self.until("an empty list", lambda: not self.scenes())
        (self.folder / "first").mkdir()
        shutil.copy(TRIANGLE, self.folder / "first" / "again.gltf")
        self.until("the file in the new folder", lambda: "again.gltf" in self.scenes())
        shutil.copy(TRIANGLE, self.folder / "first" / "another.gltf")
        self.until("another one there", lambda: "another.gltf" in self.scenes())

    def test_3_link_leads_elsewhere(self):
        (self.folder / "second").mkdir()
        shutil.copy(TRIANGLE, self.folder / "second" / "other.gltf")
        (self.folder / "next").symlink_to("second")
        (self.folder / "next").rename(self.folder / "current")
        self.until("what is there", lambda: set(self.scenes()) == {"other.gltf"})


if __name__ == "__main__":
    unittest.main()
