"""Viewers that take places from others."""

import asyncio

from case import NEVER, case

JOINS = {"newcomer_s": 5}


@case(clients=12, newcomer=True, serve=("--max-sessions", "8"), most=JOINS)
async def pausing(arena):
    """Takes a place and pauses, so that it costs nothing and stays."""
    async with arena.viewer() as viewer:
        await viewer.say(pause={"paused": True})
        await viewer.watch()


@case(clients=12, newcomer=True, serve=("--max-sessions", "8"), most=JOINS)
async def never_acknowledging(arena):
    """Takes a place and no pictures."""
    async with arena.viewer() as viewer:
        while True:
            await viewer.hear()


@case(clients=12, newcomer=True, serve=("--max-sessions", "8"), most=JOINS)
async def lost_connections(arena):
    """Loses its connection again and again: each session is kept for a while."""
    async with arena.viewer() as viewer:
        while (await viewer.hear())[0] != "frame":
            pass
        viewer.socket.transport.abort()
        await asyncio.sleep(0.2)


@case(clients=100, newcomer=True, serve=("--max-connections", "64"), most=JOINS)
async def silent_connections(arena):
    """Opens connections and says nothing at all."""
    _, writer = await arena.connect()
    try:
        await asyncio.sleep(NEVER)
    finally:
        writer.close()
