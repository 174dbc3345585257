#!/usr/bin/env python3
"""A server that drains sends its viewers to another (--advertise): handover_test.py PATH_OF_FROXEL."""

import asyncio
import json
import signal
import subprocess
import sys
import unittest

import websockets.legacy.client

from json_viewer import join

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
VIEWERS = 4
DRAIN_S = 30


class Server:
    def __init__(self, *options):
        self.process = subprocess.Popen(
            [FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind", "none", "--size", "32x32",
             "--lights", "1", "--min-fps", "0", "--log-level", "error", *options],
            stdout=subprocess.PIPE, text=True)
        self.socket_url = self.process.stdout.readline().strip().replace("http:", "ws:") + "ws"

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class Handover(unittest.IsolatedAsyncioTestCase):
    async def test_drain_viewers_are_sent_to_the_advertised_server(self):
        second = Server("--drain-seconds", "1")
        self.addCleanup(second.end)
        first = Server("--drain-seconds", str(DRAIN_S), "--advertise", second.socket_url)
        self.addCleanup(first.end)
        sockets = await asyncio.gather(*(join(first.socket_url) for _ in range(VIEWERS)))

        first.process.send_signal(signal.SIGTERM)
        moved = await asyncio.gather(*(self.follow(socket, second) for socket in sockets))
        with self.assertRaises(websockets.exceptions.InvalidStatusCode) as refused:
            await websockets.legacy.client.connect(first.socket_url, subprotocols=["froxel.v1"])
        self.assertEqual(refused.exception.status_code, 503)
        self.assertIn("Retry-After", refused.exception.headers)
        for socket in sockets:
            await socket.close()
        # Its last viewer has left, so it does not wait for the deadline.
        self.assertEqual(await asyncio.to_thread(first.process.wait, DRAIN_S / 2), 0)

        for socket in moved:  # they are alive there
            while not isinstance(await asyncio.wait_for(socket.recv(), 60), bytes):
                pass
            await socket.close()
        second.process.send_signal(signal.SIGTERM)
        self.assertEqual(await asyncio.to_thread(second.process.wait, DRAIN_S), 0)

    async def follow(self, socket, second):
        while True:
            message = await asyncio.wait_for(socket.recv(), 60)
            if isinstance(message, str) and "draining" in (said := json.loads(message)):
                break
        self.assertEqual(said["draining"]["reconnectUrl"], second.socket_url)
        self.assertTrue(0 < said["draining"]["deadlineMs"] <= DRAIN_S * 1000)
        return await join(second.socket_url)


if __name__ == "__main__":
    unittest.main()
