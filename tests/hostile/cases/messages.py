"""Viewers that say more than a server can follow."""

import asyncio
import json

from case import case
from viewer import together

PING = {"ping_p99_ms": 20}
# What drawing would cost is no matter here.
SERVE = ("--min-fps", "0", "--max-sessions", "64")


def long_lights(seq):
    """60 KB of placed lights, all of them valid."""
    lights = [{"id": n, "position": {"x": n % 17 * 0.5, "y": 1.25, "z": n % 31 * -0.5}, "radiusM": 0.001,
               "intensity": 0.125, "color": {"x": 0.5, "y": 0.25, "z": 0.125}} for n in range(1, 451)]
    return json.dumps({"seq": seq, "setPlacedLights": {"lights": lights}})


async def flood(arena, make, per_second, **hello):
    """Says what `make` gives for each seq, and wants no pictures: messages are all that it costs."""
    async with arena.viewer(**hello) as viewer:
        await viewer.say(pause={"paused": True})

        async def speak():
            while True:
                await viewer.socket.send(make(next(viewer.seq)))
                await asyncio.sleep(1 / per_second)

        await together(speak(), viewer.watch())


async def flood_bytes(arena, first, again):
    """Of WebSocket frames that python3-websockets would not send."""
    async with arena.viewer() as viewer:
        await viewer.say(pause={"paused": True})

        async def speak():
            viewer.socket.transport.write(first)
            while True:
                viewer.socket.transport.write(again)
                await asyncio.sleep(0.01)

        await together(speak(), viewer.watch())


@case(clients=16, serve=SERVE, most=PING)
async def long_json(arena):
    """JSON of 60 KB, 16 times 4 a second, which takes long to read."""
    head, tail = long_lights(10**9).split(str(10**9), 1)  # made once, so that it costs us nothing
    await flood(arena, lambda seq: head + str(seq) + tail, 4)


@case(clients=16, serve=SERVE, most=PING)
async def short_commands(arena):
    """As many small commands as fit through."""
    await flood(arena, lambda seq: f'{{"seq":{seq},"setExposure":{{"exposure":{1 + seq % 9}}}}}', 2000)


@case(clients=4, serve=SERVE, most=PING)
async def picks(arena):
    """Picks a light at every place: each looks at all of them."""
    await flood(arena, lambda seq: f'{{"seq":{seq},"pickLight":{{"id":{seq},"x":{seq % 7 / 7}}}}}', 500)


@case(clients=16, serve=SERVE, most=PING)
async def refusals(arena):
    """Nothing but what is refused; back at once when it was sent away."""
    await flood(arena, lambda seq: f'{{"seq":{seq},"setExposure":{{"exposure":-1}}}}', 500)


# 5 a second may come, and 16 at once: 7.7 in 6 s.
@case(clients=3, seconds=6, room="hall", serve=SERVE, most={**PING, "room_states_per_s": 8})
async def room_toggles(arena):
    """Asks for control and takes that back, in the honest viewer's room."""
    await flood(arena, lambda seq: f'{{"seq":{seq},"{("request", "release")[seq % 2]}Control":{{}}}}', 1000,
                room="hall")


@case(clients=8, seconds=6, serve=SERVE, most=PING)  # of which eight join in the first
async def pauses_toggled(arena):
    """Pauses and goes on as often as it can."""
    await flood(arena, lambda seq: f'{{"seq":{seq},"pause":{{"paused":{("true", "false")[seq % 2]}}}}}', 2000)


@case(clients=8, serve=SERVE, most=PING)
async def empty_fragments(arena):
    """A message that never ends, in fragments without a byte."""
    await flood_bytes(arena, bytes([0x01, 0x80, 0, 0, 0, 0]), 2000 * bytes([0x00, 0x80, 0, 0, 0, 0]))


@case(clients=8, serve=SERVE, most=PING)
async def pings(arena):
    """WebSocket pings, each of which is answered."""
    await flood_bytes(arena, b"", 500 * bytes([0x89, 0x80, 0, 0, 0, 0]))
