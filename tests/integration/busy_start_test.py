#!/usr/bin/env python3
"""A server that starts beside busy processes comes to the full size when they end: busy_start_test.py PATH_OF_FROXEL."""

import asyncio
import json
import os
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))

import websockets.legacy.client  # noqa: E402

from viewer_protocol import header_numbers  # noqa: E402

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
BUSY = 4
WIDTH, FULL_SIZE_US = 4, 113  # fields of FrameHeader
PATIENCE_S = 240


class BusyStart(unittest.IsolatedAsyncioTestCase):
    async def test_first_picture_comes_and_full_size_when_the_machine_is_free(self):
        busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(BUSY)]
        for process in busy:
            self.addCleanup(process.wait)
            self.addCleanup(process.kill)
        # A picture of the hall takes some 60 ms of two cores. The limit is one that it passes beside the others.
        server = subprocess.Popen(
            [FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind", "none", "--frame-limit", "0.3",
             "--log-level", "warn"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        url = server.stdout.readline().strip().replace("http:", "ws:") + "ws"
        socket = await websockets.legacy.client.connect(url, subprotocols=["froxel.v1"], max_size=2**26)
        await self.say(socket, 1, hello={"protocolMajor": 1})
        first = await self.picture(socket)
        for process in busy:
            process.kill()
        since = time.monotonic()
        last = first
        while last.get(WIDTH) != 640 or last.get(FULL_SIZE_US, 0) > 0:
            self.assertLess(time.monotonic() - since, PATIENCE_S, f"still {last.get(WIDTH)} pixels wide")
            last = await self.picture(socket)
        print(f"first {first.get(WIDTH)} pixels wide; 640 after {time.monotonic() - since:.1f} s", file=sys.stderr)
        await socket.close()

    async def say(self, socket, seq, **command):
        await socket.send(json.dumps({"seq": seq, **command}))
        self.seq = seq

    async def picture(self, socket):
        while not isinstance(message := await asyncio.wait_for(socket.recv(), PATIENCE_S), bytes):
            self.assertNotIn("error", json.loads(message))
        numbers = header_numbers(message)
        await self.say(socket, self.seq + 1, ack={"frameId": numbers[1]})
        return numbers


if __name__ == "__main__":
    unittest.main()
