#!/usr/bin/env python3
"""Scenes that clients bring and that stay, from outside: uploads_test.py PATH_OF_FROXEL."""

import base64
import http.client
import json
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
TUS = {"Tus-Resumable": "1.0.0"}
PART = {**TUS, "Content-Type": "application/offset+octet-stream"}
TOKEN = "a-token-of-this-test-0123456789"


def until(what, condition, seconds=60):
    end = time.monotonic() + seconds
    while not (outcome := condition()):
        if time.monotonic() > end:
            raise AssertionError(f"{what} did not come")
        time.sleep(0.01)
    return outcome


class Server:
    def __init__(self, folder, *options):
        self.process = subprocess.Popen(
            [FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind", "none", "--size", "64x48",
             "--log-level", "error", "--upload-folder", folder, *options], stdout=subprocess.PIPE, text=True)
        url = self.process.stdout.readline().strip()
        if not url:
            raise AssertionError("the server did not start")
        self.port = int(url.rsplit(":", 1)[1].strip("/"))

    def ask(self, method, path, headers=None, body=None):
        """(status, fields, body)"""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def announce(self, *files, headers=None):
        body = json.dumps({"files": [{"path": path, "bytes": size} for path, size in files]})
        status, _, answer = self.ask("POST", "/api/v1/scenes", headers, body)
        return status, json.loads(answer)

    def offset(self, upload):
        return int(self.ask("HEAD", upload, TUS)[1]["Upload-Offset"])

    def send(self, upload, offset, content):
        return self.ask("PATCH", upload, {**PART, "Upload-Offset": str(offset)}, content)[0]

    def picture(self, scene):
        """Once the server has the device."""
        while True:
            status, fields, body = self.ask("GET", f"/render?size=32x32&format=png&scene={scene}")
            if status != 503:
                return status, body

    def end(self, signal="kill"):
        getattr(self.process, signal)()
        self.process.communicate()


class Uploads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.uploads = cls.folder / "uploads"
        scene = cls.folder / "scene.glb"
        subprocess.run([FROXEL, "scene", "--out", scene, "--spheres", "1000"], check=True, capture_output=True)
        cls.scene = scene.read_bytes()
        cls.server = Server(cls.uploads, "--uploads", "auto")
        cls.addClassCleanup(lambda: cls.server.end())

    def tearDown(self):
        self.assertIsNone(self.server.process.poll(), "the server lives on")

    def bring(self):
        status, begun = self.server.announce(("a.glb", len(self.scene)))
        self.assertEqual(status, 201)
        self.assertEqual(self.server.send(begun["files"][0]["upload"], 0, self.scene), 204)
        return begun

    def remove(self, begun):
        return self.server.ask("DELETE", f"/api/v1/scenes/{begun['id']}", {"Froxel-Owner-Key": begun["owner_key"]})[0]

    def test_scene_is_drawn_and_removed_by_its_owner(self):
        begun = self.bring()
        status, _, facts = self.server.ask("GET", f"/api/v1/scenes/{begun['id']}")
        self.assertEqual(status, 200)
        facts = json.loads(facts)
        self.assertEqual((facts["state"], facts["name"], facts["received"]), ("ready", "a.glb", len(self.scene)))
        status, picture = self.server.picture(begun["id"])
        self.assertEqual((status, picture[1:4]), (200, b"PNG"))
        posted = self.server.ask("POST", "/render?size=32x32&format=png", None, self.scene)[2]
        self.assertEqual(picture, posted)
        for key in ("", "x", begun["id"]):
            answer = self.server.ask("DELETE", f"/api/v1/scenes/{begun['id']}", {"Froxel-Owner-Key": key})
            absent = self.server.ask("DELETE", f"/api/v1/scenes/{'0' * 32}", {"Froxel-Owner-Key": key})
            self.assertEqual((answer[0], answer[2]), (404, absent[2]), "no telling who has what")
        self.assertEqual(self.remove(begun), 204)
        self.assertEqual(self.server.picture(begun["id"])[0], 404)
        self.assertFalse((self.uploads / begun["id"]).exists())

    def test_each_scene_has_its_own_picture(self):
        first = self.bring()
        hall = self.folder / "hall.glb"
        subprocess.run([FROXEL, "scene", "--out", hall], check=True, capture_output=True)
        status, second = self.server.announce(("a.glb", hall.stat().st_size))
        self.assertEqual(status, 201)
        self.assertEqual(self.server.send(second["files"][0]["upload"], 0, hall.read_bytes()), 204)
        self.assertNotEqual(self.server.picture(first["id"])[1], self.server.picture(second["id"])[1])
        self.remove(first)
        self.remove(second)

    def test_connection_is_lost_at_each_byte(self):
        content = b"0123456789"
        for came in range(len(content)):
            _, begun = self.server.announce(("a.glb", len(content)))
            upload = begun["files"][0]["upload"]
            with socket.create_connection(("127.0.0.1", self.server.port)) as connection:
                fields = "".join(f"{name}: {value}\r\n" for name, value in PART.items())
                connection.sendall(f"PATCH {upload} HTTP/1.1\r\nHost: localhost\r\n{fields}Upload-Offset: 0\r\n"
                                   f"Content-Length: {len(content)}\r\n\r\n".encode() + content[:came])
                until("what was sent", lambda: self.server.offset(upload) == came)
            # Who lost it may be there again before the server knows.
            status = until("its end", lambda: (status := self.server.send(upload, came, content[came:])) != 423 and status)
            self.assertEqual(status, 204)
            self.assertEqual((self.uploads / begun["id"] / "0").read_bytes(), content)
            self.assertEqual(self.remove(begun), 204)

    def test_server_is_killed_while_a_file_comes(self):
        other = self.folder / "other"
        server = Server(other, "--uploads", "on")
        _, begun = server.announce(("a.glb", len(self.scene)), ("b.bin", 4))
        glb, part = (file["upload"] for file in begun["files"])
        half = len(self.scene) // 2
        self.assertEqual(server.send(glb, 0, self.scene[:half]), 204)
        server.end()
        server = Server(other, "--uploads", "on")
        self.addCleanup(server.end)
        self.assertEqual(server.offset(glb), half)
        self.assertEqual(server.send(glb, half, self.scene[half:]), 204)
        self.assertEqual(server.send(part, 0, b"more"), 204)
        self.assertEqual(server.picture(begun["id"])[0], 200)

    def test_tus(self):
        status, fields, _ = self.server.ask("OPTIONS", "/api/v1/uploads")
        self.assertEqual(status, 204)
        self.assertEqual((fields["Tus-Version"], fields["Tus-Extension"]), ("1.0.0", "creation,termination,expiration"))
        self.assertEqual(int(fields["Tus-Max-Size"]), 512 << 20)
        metadata = "filetype eA==,filename " + base64.b64encode("ä scene.glb".encode()).decode()
        create = {**TUS, "Upload-Length": str(len(self.scene)), "Upload-Metadata": metadata}
        status, fields, _ = self.server.ask("POST", "/api/v1/uploads", create)
        self.assertEqual(status, 201)
        upload, scene = fields["Location"], fields["Froxel-Scene"]
        self.assertEqual(self.server.send(upload, 0, self.scene), 204)
        self.assertEqual(json.loads(self.server.ask("GET", f"/api/v1/scenes/{scene}")[2])["name"], "ä scene.glb")
        self.assertEqual(self.server.ask("DELETE", upload, TUS)[0], 204)
        self.assertEqual(self.server.ask("HEAD", upload, TUS)[0], 404)

    def test_wrong_requests_are_named(self):
        _, begun = self.server.announce(("a.glb", 4))
        upload = begun["files"][0]["upload"]
        for method, path, headers, body, status, text in (
                ("HEAD", upload, {}, None, 412, ""),
                ("PATCH", upload, {**PART, "Tus-Resumable": "0.2.2", "Upload-Offset": "0"}, b"x", 412, "1.0.0"),
                ("PATCH", upload, {**PART, "Upload-Offset": "1"}, b"x", 409, "Upload-Offset is 1; expected 0"),
                ("PATCH", upload, {**PART, "Upload-Offset": "-1"}, b"x", 400, "must be a number"),
                ("PATCH", upload, {**PART, "Upload-Offset": "0"}, b"12345", 413, "the body has 5 bytes; 4 are missing"),
                ("PATCH", upload, {**PART, "Upload-Offset": "0", "Content-Type": "text/plain"}, b"x", 415, "offset+octet"),
                ("PATCH", upload + "0", {**PART, "Upload-Offset": "0"}, b"x", 404, "no such upload"),
                ("PUT", upload, TUS, b"x", 413, ""),
                ("GET", upload, TUS, None, 405, ""),
                ("POST", "/api/v1/uploads", TUS, None, 400, "Upload-Length"),
                ("POST", "/api/v1/uploads", {**TUS, "Upload-Length": "4", "Upload-Metadata": "filename !"}, None, 400,
                 "filename"),
                ("POST", "/api/v1/scenes", {}, b"{", 400, "no announcement"),
                ("POST", "/api/v1/scenes", {}, b'{"files":[{"path":"a.glb"}]}', 400, "files[0]"),
                ("POST", "/api/v1/scenes", {}, b'{"files":[{"path":"../a.glb","bytes":1}]}', 400, "without .."),
                ("POST", "/api/v1/scenes", {}, b'{"files":[{"path":"a.glb","bytes":1e99}]}', 400, "files[0]"),
                ("POST", "/api/v1/scenes", {}, b" " * 300_000, 413, "262144"),
                ("POST", "/api/v1/scenes", {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "cors"},
                 b'{"files":[{"path":"a.glb","bytes":1}]}', 403, "foreign"),
                ("DELETE", f"/api/v1/scenes/{begun['id']}", {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "cors",
                 "Froxel-Owner-Key": begun["owner_key"]}, None, 403, "foreign")):
            with self.subTest(method=method, path=path, headers=headers):
                got, _, answer = self.server.ask(method, path, headers, body)
                self.assertEqual(got, status, answer)
                self.assertIn(text, answer.decode())
        self.assertEqual(self.remove(begun), 204)

    def test_file_that_is_no_scene_is_refused_when_it_is_shown(self):
        _, begun = self.server.announce(("a.glb", 4))
        self.assertEqual(self.server.send(begun["files"][0]["upload"], 0, b"glTF"), 204)
        status, answer = self.server.picture(begun["id"])
        self.assertEqual(status, 400)
        self.assertIn("a.glb: ", json.loads(answer)["message"])
        self.remove(begun)

    def test_who_may(self):
        tokens = self.folder / "tokens"
        tokens.write_text(TOKEN + "\n")
        for options, headers, status in ((("--uploads", "off"), {}, 403),
                                         (("--uploads", "auto", "--allow-host", "localhost.example"), {}, 403),
                                         (("--uploads", "auto", "--token-file", tokens), {}, 401),
                                         (("--uploads", "auto", "--token-file", tokens),
                                          {"Authorization": f"Bearer {TOKEN}"}, 201)):
            with self.subTest(options=options):
                server = Server(tempfile.mkdtemp(dir=self.folder), *options)
                self.addCleanup(server.end)
                body = json.dumps({"files": [{"path": "a.glb", "bytes": 4}]})
                self.assertEqual(server.ask("POST", "/api/v1/scenes", headers, body)[0], status)
                if status == 403:
                    self.assertEqual(server.ask("HEAD", "/api/v1/uploads/x-0", TUS)[0], 403)
                    status, fields, _ = server.ask("OPTIONS", "/api/v1/uploads")
                    self.assertEqual((status, fields["Tus-Version"]), (204, None), "no error in a page's console")
        refused = subprocess.run([FROXEL, "serve", "--uploads", "on", "--sandbox", "off", "--port", "0"],
                                 capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--uploads needs a process", refused.stderr)


if __name__ == "__main__":
    unittest.main()
