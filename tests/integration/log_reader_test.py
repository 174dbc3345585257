#!/usr/bin/env python3
"""Whoever reads the log stands still, leaves, or was never there: log_reader_test.py PATH_OF_FROXEL.

The service goes on, and it ends when it is told to.
"""

import asyncio
import fcntl
import os
import re
import signal
import subprocess
import sys
import termios
import unittest
import urllib.request

from json_viewer import join

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
SERVE = [FROXEL, "serve", "--device", "cpu", "--size", "32x32", "--lights", "1", "--min-fps", "0",
         "--max-sessions", "64", "--port", "0",
         "--admin-bind", "127.0.0.1:0", "--log-level", "debug"]
VIEWERS = 30
PIPE = 4096


class Server:
    """Its log goes into a pipe of 4096 bytes, `log`, which nobody reads yet."""

    def __init__(self):
        self.log, into = os.pipe()
        fcntl.fcntl(into, fcntl.F_SETPIPE_SZ, PIPE)
        self.process = subprocess.Popen(SERVE, stdout=subprocess.PIPE, stderr=into, text=True)
        os.close(into)
        self.url = self.process.stdout.readline().strip()
        self.admin = self.process.stdout.readline().strip().removesuffix("metrics")

    async def get(self, path):
        def fetch():
            with urllib.request.urlopen(self.admin + path, timeout=60) as answer:
                return answer.read().decode()
        return await asyncio.to_thread(fetch)

    async def lost(self):
        return float(re.search(r"^froxel_log_lines_lost_total (\S+)$", await self.get("metrics"), re.M)[1])

    async def visit(self):
        """A viewer has a picture and leaves; that is some lines of the log."""
        socket = await join(self.url.replace("http:", "ws:") + "ws")
        await socket.close()

    async def ends(self):
        self.process.send_signal(signal.SIGTERM)
        return await asyncio.to_thread(self.process.wait, 60)

    def clean(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class LogReader(unittest.IsolatedAsyncioTestCase):
    def serve(self):
        server = Server()
        self.addCleanup(server.clean)
        return server

    async def test_reader_stands_still_viewers_go_on_and_sigterm_ends_it(self):
        server = self.serve()
        for _ in range(VIEWERS):
            await server.visit()
        waiting = int.from_bytes(fcntl.ioctl(server.log, termios.FIONREAD, bytes(4)), sys.byteorder)
        self.assertGreater(waiting, PIPE // 2, "the pipe was to be full")
        self.assertIn("ok", await server.get("livez"))
        self.assertEqual(await server.ends(), 0)
        os.close(server.log)

    async def test_reader_comes_back_and_finds_whole_lines(self):
        server = self.serve()
        for _ in range(VIEWERS):
            await server.visit()
        ended = asyncio.create_task(server.ends())
        with open(server.log, encoding="ascii") as log:
            lines = await asyncio.to_thread(log.readlines)
        self.assertEqual(await ended, 0)
        for line in lines:
            self.assertRegex(line, r"^\d{4}-\d\d-\d\dT\S+ (debug|info|warning|error) .*\n$")
        self.assertTrue(any("event=drained" in line for line in lines), lines[-3:])

    async def test_reader_leaves_viewers_go_on_and_what_it_misses_is_counted(self):
        server = self.serve()
        await server.visit()
        self.assertEqual(await server.lost(), 0)
        os.close(server.log)
        await server.visit()
        async with asyncio.timeout(60):
            while await server.lost() == 0:
                await asyncio.sleep(0.05)
        await server.visit()
        self.assertIn("ok", await server.get("livez"))
        self.assertEqual(await server.ends(), 0)



if __name__ == "__main__":
    unittest.main()
