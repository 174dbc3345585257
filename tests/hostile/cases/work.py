"""Viewers that ask for as much drawing as they are let."""

import asyncio
import itertools
import subprocess

from case import case
from viewer import together

JOINS = {"newcomer_s": 3}
SECONDS = 6  # until some of these are let do what they want
SLOW_TO_BEGIN = 20  # shaders are compiled first, and a frame may take seconds on a busy machine
HUGE_LIGHT = {"id": 1, "position": {"y": 2}, "radiusM": 10_000, "intensity": 1}


async def as_many_lights_as_taken(viewer, radius_m):
    """Finds how many by halving, and goes on with them for ever."""
    count = 1_000_000
    while True:
        await viewer.say(setLights={"count": count, "radiusM": radius_m})
        while (heard := await viewer.hear())[0] not in ("error", "frame"):
            pass
        if heard[0] == "frame":
            await viewer.acknowledge(heard[1])
        else:
            count = max(count // 2, 1)


async def as_large_as_taken(viewer, width, height):
    """A picture of that size, or of half its sides and so on, until some come: heard as "large"."""
    while width >= 16 and height >= 16:
        await viewer.say(setSize={"width": width, "height": height})
        frames = 0
        while (heard := await viewer.hear())[0] != "error" and frames < 2:
            if heard[0] == "frame":
                frames += 1
                await viewer.acknowledge(heard[1])
        if heard[0] != "error":
            viewer.heard["large"] += 1
            return
        width, height = width // 2, height // 2


@case(seconds=SLOW_TO_BEGIN, needs=("frame",))
async def long_lists(arena):
    """A million tiny lights in a grid of one column: what most pixels loop over is in few lists."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 640, "height": 360})
        await viewer.say(setGrid={"grid": {"x": 1, "y": 1, "z": 256}})
        await viewer.say(setPlacedLights={"lights": [HUGE_LIGHT]})
        await viewer.say(setLights={"count": 1_000_000, "radiusM": 0.01, "lightLoop": "LIGHT_LOOP_LISTS"})
        await viewer.watch()


@case(seconds=SECONDS, needs=("frame",), newcomer=True, most=JOINS)
async def all_lights(arena):
    """Naive shading with as many lights as are taken, found by halving."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 1280, "height": 720})
        await viewer.say(setRenderer={"renderer": "RENDERER_NAIVE"})
        await as_many_lights_as_taken(viewer, 1000)


@case(seconds=SLOW_TO_BEGIN, needs=("large",), newcomer=True, most=JOINS)
async def huge_pictures(arena):
    """The largest picture, with every map of shadows and the widest bloom."""
    async with arena.viewer() as viewer:
        await viewer.say(setShadows={"lights": 32, "size": 512})
        await viewer.say(setPost={"bloom": "BLOOM_KIND_SEPARABLE", "bloomRadius": 0.05})
        await as_large_as_taken(viewer, 4096, 4096)
        await viewer.watch()


@case(seconds=SECONDS, needs=("large",))
async def four_samples(arena):
    """As large a picture as four samples a pixel are given for."""
    async with arena.viewer() as viewer:
        await viewer.say(setPost={"antialiasing": "ANTIALIASING_SSAA4"})
        await as_large_as_taken(viewer, 2048, 2048)
        await viewer.watch()


@case(seconds=SECONDS, needs=("large",))
async def fog_and_layers(arena):
    """The finest volume of fog, and sixteen layers of what is blended."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 64, "height": 64})
        await viewer.say(setFog={"fog": {"density": 0.1, "tile": 4, "slices": 256}})
        await viewer.say(setTransparency={"transparency": "TRANSPARENCY_PEELED", "peelLayers": 16})
        await as_large_as_taken(viewer, 1280, 720)
        await viewer.watch()


@case(seconds=SECONDS, needs=("frame",))
async def many_wires(arena):
    """The ends of as many lights as are taken, as lines, which pixels have no say in."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 64, "height": 64})
        await viewer.say(setDebugView={"view": "DEBUG_VIEW_LIGHT_SPHERES"})
        await as_many_lights_as_taken(viewer, 0.1)


@case(seconds=SECONDS, needs=("frame",), newcomer=True, most=JOINS)
async def a_frame_a_connection(arena):
    """One large picture, then a new connection, which owes nothing yet."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 1920, "height": 1080})
        await viewer.say(setLights={"count": 5000, "radiusM": 2})
        while True:
            name, _ = await viewer.hear()
            if name == "frame" and viewer.heard["frame"] % 2 == 0:
                return


@case(seconds=SECONDS, clients=4)
async def leaves_at_once(arena):
    """Asks for a large picture and is gone before it is there."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 2048, "height": 2048})
        await viewer.say(setLights={"count": 20_000, "radiusM": 2})
        while (await viewer.hear())[0] not in ("state", "error"):
            pass
        await asyncio.sleep(0.05)


@case(seconds=SECONDS)
async def shader_storm(arena):
    """Ever other variants of the renderer, each to be compiled."""
    variants = itertools.product(
        ("NAIVE", "FORWARD_PLUS", "CLUSTERED_DEFERRED", "TOON_FRAGMENT", "TOON_COMPUTE"),
        ("PBR", "LAMBERT", "BLINN_PHONG"), ("COMPUTE", "FRAGMENT"), ("NONE", "FXAA", "SSAA4"),
        ("SORTED", "WEIGHTED", "PEELED"))

    async def ask(viewer):
        for renderer, shading, lighting, antialiasing, transparency in itertools.cycle(variants):
            await viewer.say(setRenderer={"renderer": f"RENDERER_{renderer}",
                                          "shading": f"SHADING_MODEL_{shading}",
                                          "lighting": f"LIGHTING_STAGE_{lighting}"})
            await viewer.say(setPost={"antialiasing": f"ANTIALIASING_{antialiasing}"})
            await viewer.say(setTransparency={"transparency": f"TRANSPARENCY_{transparency}"})
            await asyncio.sleep(0.1)

    async with arena.viewer() as viewer:
        await together(ask(viewer), viewer.watch())


@case(seconds=SECONDS)
async def sizes_storm(arena):
    """Another size with every picture, so that targets are made anew."""
    async with arena.viewer() as viewer:
        for step in itertools.count():
            await viewer.say(setSize={"width": 1024 + step * 13 % 1024, "height": 1024 + step * 7 % 512})
            while (heard := await viewer.hear())[0] != "frame":
                pass
            await viewer.acknowledge(heard[1])


@case(seconds=SECONDS, needs=("frame",))
async def encodings_storm(arena):
    """Another size, quality, chroma and codec with every picture, so that encoders are made anew wherever they are."""
    async with arena.viewer(codecs=["CODEC_VP9"]) as viewer:
        for step in itertools.count():
            await viewer.say(setSize={"width": 320 + step * 13 % 320, "height": 180 + step * 7 % 180})
            await viewer.say(setEncoding={"codec": ("CODEC_JPEG", "CODEC_VP9")[step % 2],
                                          "chroma": ("CHROMA_420", "CHROMA_444")[step // 2 % 2],
                                          "quality": 1 + step * 37 % 100})
            while (heard := await viewer.hear())[0] != "frame":
                pass
            await viewer.acknowledge(heard[1])


@case(seconds=SECONDS, needs=("frame",))
async def lights_anew(arena):
    """A million lights, then few, and so on, in a tiny picture: what the host makes of them is made anew."""
    async with arena.viewer() as viewer:
        await viewer.say(setSize={"width": 16, "height": 16})
        await viewer.say(setGrid={"grid": {"x": 34, "y": 1, "z": 256}})
        for count in itertools.cycle((1_000_000, 10)):
            await viewer.say(setLights={"count": count, "radiusM": 0.001, "lightLoop": "LIGHT_LOOP_LISTS"})
            while (heard := await viewer.hear())[0] != "frame":
                pass
            await viewer.acknowledge(heard[1])


@case(seconds=20)
async def storms(arena):
    """Two viewers that change every setting over its whole range, 200 times a second."""
    command = [arena.froxel, "load", arena.url, "--viewers", "2", "--script", "storm", "--seconds", "3600"]
    load = await asyncio.create_subprocess_exec(*command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        said, _ = await load.communicate()
        raise RuntimeError(f"froxel load ended: {said.decode().strip()}")
    finally:
        if load.returncode is None:
            load.kill()
