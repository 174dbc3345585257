"""Viewers that have ever other scenes read, and who ask for ever other stills."""

import asyncio
import itertools
import json

from case import case
from viewer import together

JOINS = {"newcomer_s": 5}
SECONDS = 6  # a scene takes a second and more
FEW_MB = ("--scene-memory", "64")  # two of these scenes, so that others must leave
# Reading and decoding take a core that a software device draws with.
BESIDE_READING = {"kept": 0.15}


async def scenes_of(arena):
    """The ids that the server lists."""
    async with arena.asking("/api/v1/scenes") as reader:
        answer = await reader.read()
    return [scene["id"] for scene in json.loads(answer.split(b"\r\n\r\n", 1)[1])["scenes"]]


def views(arena):
    """Names of pictures that nobody has asked for."""
    for number in itertools.count():
        yield f"lights=50&exposure={1 + arena.index + 1e-4 * number:.4f}"


@case(clients=4, seconds=SECONDS, scenes=True, serve=FEW_MB, needs=("sceneChanged",), newcomer=True, most=JOINS,
      least=BESIDE_READING)
async def scenes_in_turn(arena):
    """Goes over to the next scene once one is there, or cannot be read; the device has room for some."""
    scenes = await scenes_of(arena)
    async with arena.viewer() as viewer:
        for number in itertools.count(arena.index):
            await viewer.say(selectScene={"scene": scenes[number % len(scenes)]})
            while (heard := await viewer.hear())[0] not in ("sceneChanged", "error"):
                if heard[0] == "frame":
                    await viewer.acknowledge(heard[1])


@case(clients=4, seconds=SECONDS, scenes=True, serve=FEW_MB, needs=("sceneLoading",), newcomer=True, most=JOINS,
      least=BESIDE_READING)
async def scenes_called_off(arena):
    """Chooses another scene, and in a moment the first again, ten times a second."""
    scenes = await scenes_of(arena)

    async def choose(viewer):
        for number in itertools.count(arena.index):
            await viewer.say(selectScene={"scene": scenes[number % len(scenes)]})
            await asyncio.sleep(0.05)
            await viewer.say(selectScene={"scene": scenes[0]})
            await asyncio.sleep(0.05)

    async with arena.viewer() as viewer:
        await together(choose(viewer), viewer.watch())


@case(clients=8, seconds=SECONDS, scenes=True, serve=FEW_MB, needs=("still",), newcomer=True, most=JOINS)
async def stills_of_all_scenes(arena):
    """Asks for stills of each scene in turn."""
    scenes = await scenes_of(arena)
    for scene, view in zip(itertools.cycle(scenes), views(arena)):
        async with arena.asking(f"/render?scene={scene}&size=160x90&{view}") as reader:
            arena.heard["still"] += b"image/jpeg" in await reader.read()


@case(clients=8, needs=("given up",), newcomer=True, most=JOINS)
async def stills_given_up(arena):
    """Asks for a still and goes away before it is there."""
    async def ask(view):
        async with arena.asking(f"/render?size=640x360&{view}"):
            pass

    for view in views(arena):
        try:
            await asyncio.wait_for(ask(view), 0.02)
        except asyncio.TimeoutError:
            arena.heard["given up"] += 1


@case(clients=8, seconds=10, scenes=True, slow_files=4, serve=FEW_MB, needs=("selected",), newcomer=True, most=JOINS,
      least=BESIDE_READING)
async def slow_files(arena):
    """Asks for pictures of files that take seconds to read; who selects a scene that does not must have it soon."""
    async with arena.asking("/api/v1/scenes?limit=200") as reader:
        listed = json.loads((await reader.read()).split(b"\r\n\r\n", 1)[1])["scenes"]
    slow = [scene["id"] for scene in listed if scene["name"].startswith("slow")]
    quick = [scene["id"] for scene in listed if scene["name"] in "0123"]
    if arena.index > 0:
        for scene, view in zip(itertools.cycle(slow), views(arena)):
            async with arena.asking(f"/render?scene={scene}&size=160x90&{view}") as reader:
                await reader.read()
        return
    async with arena.viewer() as viewer:
        for scene in itertools.cycle(quick):
            await viewer.say(selectScene={"scene": scene})
            await asyncio.wait_for(until_changed(viewer), 8)
            arena.heard["selected"] += 1


async def until_changed(viewer):
    while (heard := await viewer.hear())[0] not in ("sceneChanged", "error"):
        if heard[0] == "frame":
            await viewer.acknowledge(heard[1])
