#!/usr/bin/env python3
"""Many slow HTTP clients, by Debian's slowhttptest: slow_http_test.py PATH_OF_FROXEL.

Meanwhile a viewer has its pictures, requests are answered, and afterwards nothing is left of the slow
ones.
"""

import asyncio
import json
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request
from pathlib import Path

import websockets

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import told_skips
from viewer_protocol import frame_id

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
CONNECTIONS = 50
# Of the tool, at most; the server gives a request 10 s, and its answer 10 s.
SECONDS = 40


class Viewer:
    def __init__(self, url):
        self.frames = 0
        self.task = asyncio.create_task(self.watch(url))

    async def watch(self, url):
        async with websockets.connect(url, subprotocols=["froxel.v1"], max_size=2**26) as socket:
            await socket.send(json.dumps({"seq": 1, "hello": {"protocolMajor": 1}}))
            seq = 1
            async for message in socket:
                if isinstance(message, bytes):
                    self.frames += 1
                    seq += 1
                    await asyncio.sleep(0.05)
                    await socket.send(json.dumps({"seq": seq, "ack": {"frameId": frame_id(message)}}))


@unittest.skipUnless(shutil.which("slowhttptest"), "slowhttptest is not here (Debian: slowhttptest)")
class SlowHttp(unittest.IsolatedAsyncioTestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        page = Path(folder.name)
        (page / "index.html").write_text("<p>page</p>")
        (page / "long.txt").write_bytes(b"x" * 2**24)  # more than the kernel takes for a slow reader
        cls.server = subprocess.Popen(
            [FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind", "127.0.0.1:0",
             "--size", "32x32", "--lights", "1", "--min-fps", "0", "--web-root", page,
             "--drain-seconds", "1", "--log-level", "error"], stdout=subprocess.PIPE, text=True)
        cls.addClassCleanup(cls.server.wait)
        cls.addClassCleanup(cls.server.kill)
        cls.addClassCleanup(cls.server.stdout.close)
        cls.url = cls.server.stdout.readline().strip()
        cls.metrics_url = cls.server.stdout.readline().strip()

    async def get(self, url):
        def read():
            with urllib.request.urlopen(url, timeout=60) as answer:
                return answer.read().decode()
        return await asyncio.to_thread(read)

    async def descriptors(self):
        text = await self.get(self.metrics_url)
        return int(float(re.search(r"^process_open_fds (\S+)", text, re.M)[1]))

    async def attack(self, *options):
        """Until the server is rid of the tool's connections. The most that there were, whether the tool still ran
        then, and what it said."""
        viewer = Viewer(self.url.replace("http:", "ws:") + "ws")
        try:
            await self.frames_after(viewer, 2)
            before = most = await self.descriptors()
            tool = await asyncio.create_subprocess_exec(
                "slowhttptest", "-c", str(CONNECTIONS), "-r", str(CONNECTIONS), "-l", str(SECONDS), *options,
                stdout=subprocess.PIPE)
            self.addCleanup(lambda: tool.returncode is None and tool.kill())
            output = asyncio.create_task(tool.stdout.read())
            now = before
            while not output.done() and not now <= before < most - CONNECTIONS / 2:
                self.assertIn("serving", await self.get(self.url + "healthz"))
                await self.frames_after(viewer, 1)
                await asyncio.wait([output], timeout=0.2)
                now = await self.descriptors()
                most = max(most, now)
            still_there = not output.done()
            if still_there:
                tool.send_signal(signal.SIGINT)
            said = (await output).decode()
            await tool.wait()
            while await self.descriptors() > before:
                await asyncio.sleep(0.1)
            await self.frames_after(viewer, 1)
        finally:
            viewer.task.cancel()
            await asyncio.gather(viewer.task, return_exceptions=True)
        return most - before, still_there, said

    async def frames_after(self, viewer, count):
        """Waits for as many more; on a busy machine they may take long."""
        wanted, end = viewer.frames + count, time.monotonic() + 60
        while viewer.frames < wanted:
            self.assertFalse(viewer.task.done(), "the viewer was sent away")
            self.assertLess(time.monotonic(), end, "the viewer's pictures stopped")
            await asyncio.sleep(0.02)

    async def test_headers_that_never_end_are_given_up(self):
        most, _, said = await self.attack("-H", "-i", "1", "-u", self.url)
        self.assertGreaterEqual(most, CONNECTIONS)
        self.assertNotIn("time limit", said)

    async def test_bodies_are_refused_before_they_come(self):
        _, _, said = await self.attack("-B", "-i", "1", "-s", "8192", "-u", self.url)
        self.assertIn("No open connections left", said)

    async def test_answers_that_nobody_reads_are_given_up(self):
        most, still_there, _ = await self.attack("-X", "-n", "1", "-w", "64", "-y", "256", "-z", "32",
                                                 "-u", self.url + "long.txt")
        self.assertGreaterEqual(most, CONNECTIONS)
        self.assertTrue(still_there, "the tool hung up, not the server")


if __name__ == "__main__":
    told_skips.main()
