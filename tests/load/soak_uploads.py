"""Viewers upload scenes, switch to them, call loads off and delete them; says whether anything is left behind.

Usage: soak_uploads.py FROXEL [--minutes 10] [--viewers 16] [--seed 1] [-- OPTIONS OF froxel serve]

Each viewer has a WebSocket and, again and again, one of six scenes, one of them broken. It sends the scene in pieces, of
which some break off and are continued. It cancels some uploads and selects the others. Half of the loads are called off
by another choice. In the end it deletes what it sent. Passes if

  - every answer is one that the protocol knows, and every scene that is whole becomes the viewer's;
  - nothing is left in the folder of uploads, no session and no descriptor, once all have left;
  - the heap at rest rises by less than 8 MB from the first third of the time to the end;
  - the server answers each scrape within 5 s, and ends with exit code 0.

Exit code 0: passed; 1: failed; 2: usage.
"""

import argparse
import asyncio
import collections
import http.client
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "hostile"))
from broken_files import OBJ, STL_TEXT, WHOLE
from server import Server, split_arguments
from viewer import Viewer as Socket

TUS = {"Tus-Resumable": "1.0.0"}
HEAP_RISE_BYTES = 8e6
CHOOSE_EVERY_S = 2.2  # of two choices: a session may make one a second


class Failed(Exception):
    pass


class Viewer:
    def __init__(self, server, scenes, dice, heard):
        self.server, self.address, self.first = server, server.url.split("/")[2], ""
        self.scenes, self.dice, self.heard = scenes, dice, heard

    async def ask(self, method, path, fields=None, body=None, of=()):
        def blocking():
            connection = http.client.HTTPConnection(self.address, timeout=60)
            try:
                connection.request(method, path, body, fields or {})
                answer = connection.getresponse()
                return answer.status, answer.headers, answer.read()
            finally:
                connection.close()

        status, headers, text = await asyncio.to_thread(blocking)
        self.heard[f"{method} {status}"] += 1
        if status not in of:
            raise Failed(f"{method} {path.split('/')[3]} was answered {status}: {text[:300]}")
        return status, headers, text

    async def upload(self, name, content):
        """(id, owner key), or None where it was called off or there was no room."""
        body = json.dumps({"files": [{"path": name, "bytes": len(content)}]})
        status, _, answer = await self.ask("POST", "/api/v1/scenes", body=body, of=(201, 429))
        if status == 429:
            await asyncio.sleep(0.1)
            return None
        begun = json.loads(answer)
        url = begun["files"][0]["upload"]
        at = 0
        while at < len(content):
            if self.dice.random() < 0.05:
                await self.ask("DELETE", url, TUS, of=(204,))
                return None
            if self.dice.random() < 0.1:
                await asyncio.to_thread(self.break_off, url, at, content)
                at = int((await self.ask("HEAD", url, TUS, of=(200,)))[1]["Upload-Offset"])
                continue
            part = content[at : at + max(1, len(content) // self.dice.choice((1, 1, 2, 5)))]
            fields = {**TUS, "Content-Type": "application/offset+octet-stream", "Upload-Offset": str(at)}
            try:
                await self.ask("PATCH", url, fields, part, of=(204, 409, 423))
            except OSError:
                self.heard["PATCH hung up"] += 1  # 423 before all of it was sent
            at = int((await self.ask("HEAD", url, TUS, of=(200,)))[1]["Upload-Offset"])
        return begun["id"], begun["owner_key"]

    def break_off(self, url, at, content):
        """A part whose connection is lost in the middle."""
        connection = http.client.HTTPConnection(self.address, timeout=60)
        connection.putrequest("PATCH", url)
        for field in (("Tus-Resumable", "1.0.0"), ("Content-Type", "application/offset+octet-stream"),
                      ("Upload-Offset", str(at)), ("Content-Length", str(len(content) - at))):
            connection.putheader(*field)
        try:
            connection.endheaders()
            connection.send(content[at : at + (len(content) - at) // 2])
        except OSError:
            pass  # the server refused it, since what broke off before has not ended yet
        connection.close()

    async def choose(self, socket, scene):
        """What became of the choice: sceneChanged, error or called off."""
        await asyncio.sleep(CHOOSE_EVERY_S)
        await socket.say(selectScene={"scene": scene})
        if self.dice.random() < 0.5:
            await asyncio.sleep(self.dice.random() * 0.1)
            scene = self.first
            await socket.say(selectScene={"scene": scene})
        patience_s = 2 if scene == self.first else 120  # the scene that is shown is chosen in silence
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            name, content = await asyncio.wait_for(socket.hear(), 60)
            if name == "frame":
                await socket.acknowledge(content)
            elif name == "error" and content["code"] in ("ERROR_CODE_RATE_LIMIT", "ERROR_CODE_DEVICE", "ERROR_CODE_MALFORMED"):
                raise Failed(f"a choice was answered {content}")
            elif name == "error" or name == "sceneChanged" and content["scene"]["id"] == scene:
                return name
        if scene == self.first:
            return "called off"
        raise Failed("a choice was not answered within two minutes")

    async def run(self, end):
        async with Socket(self.server.url, "127.0.0.1", self.heard) as socket:
            self.first = socket.welcome["scene"]["id"]
            while time.monotonic() < end:
                sent = await self.upload(*self.dice.choice(self.scenes))
                if sent is None:
                    continue
                self.heard["chosen: " + await self.choose(socket, sent[0])] += 1
                await self.ask("DELETE", f"/api/v1/scenes/{sent[0]}", {"Froxel-Owner-Key": sent[1]}, of=(204, 404))


def at_rest(server):
    """Once no session is left; None where that does not come."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        time.sleep(2)
        values = server.sample()
        if values["froxel_sessions"] == 0:
            return values
    return None


async def round_of(server, scenes, options, number, heard):
    end = time.monotonic() + min(60.0, options.minutes * 60 / 4)
    viewers = [Viewer(server, scenes, random.Random(f"{options.seed} {number} {i}"), heard) for i in range(options.viewers)]
    outcomes = await asyncio.gather(*(viewer.run(end) for viewer in viewers), return_exceptions=True)
    return [repr(outcome) for outcome in outcomes if outcome is not None]


def main():
    own, serve = split_arguments()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("froxel")
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--viewers", type=int, default=16)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args(own)
    faults, heard, rest = [], collections.Counter(), []
    with tempfile.TemporaryDirectory() as folder:
        hall = Path(folder) / "hall.glb"
        subprocess.run([options.froxel, "scene", "--out", hall, "--log-level", "error"], check=True, stdout=subprocess.DEVNULL)
        scenes = [("hall.glb", hall.read_bytes()), ("a.glb", WHOLE["glb"]), ("a.obj", OBJ), ("a.stl", STL_TEXT),
                  ("a.3mf", WHOLE["3mf"]), ("broken.glb", WHOLE["glb"][:-40])]
        store = Path(folder) / "uploads"
        # One address sends all of it.
        server = Server(options.froxel, "--upload-folder", store, "--uploads", "on", "--max-sessions", str(options.viewers),
                        "--max-sessions-per-address", str(options.viewers), "--min-fps", "0", "--size", "64x48", "--drain-seconds", "1", *serve)
        end = time.monotonic() + options.minutes * 60
        while time.monotonic() < end and not faults:
            faults += asyncio.run(round_of(server, scenes, options, len(rest), heard))
            values = at_rest(server)
            if values is None or values["scrape_s"] > 5:
                faults.append("a session is left, or /metrics took longer than 5 s")
                break
            rest.append(values)
            print(f"{len(rest)}: {dict(heard)}, heap {values['process_heap_used_bytes'] / 1e6:.1f} MB, "
                  f"descriptors {values['process_open_fds']:.0f}", flush=True)
        left = [path.name for path in store.iterdir() if path.is_dir()]
        if server.stop() != 0:
            faults.append("the server ended with another code than 0")
    warm = rest[: max(1, len(rest) // 3)]
    if rest and rest[-1]["process_heap_used_bytes"] - warm[-1]["process_heap_used_bytes"] > HEAP_RISE_BYTES:
        faults.append("the heap at rest rose")
    if rest and rest[-1]["process_open_fds"] > warm[-1]["process_open_fds"]:
        faults.append("descriptors are left")
    faults += [f"uploads are left: {len(left)}"] if left else []
    faults += ["no scene was ever shown"] if heard["chosen: sceneChanged"] == 0 else []
    print("failed: " + "; ".join(faults) if faults else "passed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
