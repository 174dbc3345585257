"""Viewers in JSON: the honest one that is measured, and what hostile ones are made of."""

import asyncio
import collections
import itertools
import json
import math
import sys
import time
from pathlib import Path

import websockets.legacy.client  # the client that 10.4 (Debian 12) and 15 (Debian 13) share

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from viewer_protocol import frame_id

FIRST_PICTURE_S = 60  # a software device compiles shaders before it


async def together(*works):
    """Does all of them until the first ends, or fails, and with that the others."""
    tasks = [asyncio.ensure_future(work) for work in works]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    await done.pop()


class Viewer:
    """A connection that has said Hello, from `async with` on. `heard` counts what came, by name."""

    def __init__(self, url, address, heard=None, **hello):
        self.url, self.address = url.replace("http", "ws", 1) + "ws", address
        self.hello = {"protocolMajor": 1, "clientName": "tests/hostile", **hello}
        self.heard = collections.Counter() if heard is None else heard
        self.welcome, self.socket, self.seq = None, None, itertools.count(1)

    async def __aenter__(self):
        self.socket = await websockets.legacy.client.connect(
            self.url, subprotocols=["froxel.v1"], max_size=2**26, ping_interval=None,
            local_addr=(self.address, 0), open_timeout=30, close_timeout=1, compression=None)
        await self.say(hello=self.hello)
        while self.welcome is None:
            await self.hear()
        return self

    async def __aexit__(self, *_):
        await self.socket.close()

    async def say(self, **body):
        await self.socket.send(json.dumps({"seq": next(self.seq), **body}))

    async def hear(self):
        """(name, content) of the next message; a picture's are "frame" and its bytes."""
        message = await asyncio.wait_for(self.socket.recv(), FIRST_PICTURE_S)
        if isinstance(message, bytes):
            name, content = "frame", message
        else:
            [(name, content)] = json.loads(message).items()
        self.heard[name] += 1
        if name == "welcome":
            self.welcome = content
        if name == "error":
            self.heard[content["code"]] += 1
        return name, content

    async def acknowledge(self, frame):
        await self.say(ack={"frameId": frame_id(frame)})

    async def watch(self):
        """Takes every picture that comes, for ever."""
        while True:
            name, content = await self.hear()
            if name == "frame":
                await self.acknowledge(content)


class Victim(Viewer):
    """Moves its camera with every picture, as who drags it over the page does."""

    PING_EVERY_S = 0.02

    async def run(self):
        """Until it is cancelled; frames and pings are noted as (when, how long)."""
        self.frames, self.pings = [], []
        await together(self.move(), self.ping())

    async def move(self):
        eye, angle = self.welcome["state"]["eye"], 0
        while True:
            name, frame = await self.hear()
            if name != "frame":
                continue
            self.frames.append(time.monotonic())
            await self.acknowledge(frame)
            angle += 0.1
            moved = {"x": eye.get("x", 0) + 0.3 * math.cos(angle), "y": eye.get("y", 0),
                     "z": eye.get("z", 0) + 0.3 * math.sin(angle)}
            await self.say(setCamera={"eye": moved, "target": self.welcome["state"]["target"]})

    async def ping(self):
        while True:
            begin = time.monotonic()
            await (await self.socket.ping())
            self.pings.append((begin, time.monotonic() - begin))
            await asyncio.sleep(self.PING_EVERY_S)

    def figures(self, begin, end):
        """Of what came in between: frames a second, the longest time without one, pings."""
        frames = [begin, *(at for at in self.frames if begin <= at <= end), end]
        pings = sorted(took for at, took in self.pings if begin <= at <= end)
        pings = pings or [end - begin]
        return {"fps": (len(frames) - 2) / (end - begin),
                "gap_s": max(b - a for a, b in zip(frames, frames[1:])),
                "ping_p99_ms": 1e3 * pings[math.ceil(0.99 * len(pings)) - 1]}
