"""Who asks by HTTP: floods, guesses, pages of other sites, and answers that nobody reads."""

import asyncio
import itertools
import json
import re

from broken_files import broken_files
from case import NEVER, case

JOINS = {"newcomer_s": 5}
TOKEN = "the-token-of-this-server-which-nobody-guesses"


async def ask_on(reader, writer, arena, path, *fields):
    """Asks on a connection that stays; the answer's body. Its status is heard."""
    lines = "".join(f"{field}\r\n" for field in fields)
    writer.write(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n{lines}\r\n".encode())
    head = await reader.readuntil(b"\r\n\r\n")
    arena.heard[f"HTTP {head.split()[1].decode()}"] += 1
    for line in head.lower().split(b"\r\n"):
        if line.startswith(b"content-length:"):
            return await reader.readexactly(int(line.split(b":")[1]))
    return b""


async def keep_asking(arena, path, *fields):
    while True:
        reader, writer = await arena.connect()
        try:
            while True:
                await ask_on(reader, writer, arena, path, *fields)
        except asyncio.IncompleteReadError:
            arena.heard["hung up"] += 1
        finally:
            writer.close()


@case(clients=8, seconds=6, files=5000, needs=("HTTP 200",), newcomer=True, most=JOINS)
async def listing_flood(arena):
    """Asks for the longest list of 5,000 scenes, again and again."""
    await keep_asking(arena, "/api/v1/scenes?limit=200")


@case(clients=8, seconds=15, token=TOKEN, files=5, needs=("HTTP 401", "HTTP 429"))
async def token_guesses(arena):
    """Asks with ever other tokens."""
    for number in itertools.count():
        reader, writer = await arena.connect()
        try:
            await ask_on(reader, writer, arena, "/api/v1/scenes", f"Authorization: Bearer guess-{arena.index}-{number}")
        finally:
            writer.close()


@case(clients=4, needs=("HTTP 403",), least={"kept": 0.8})
async def foreign_pages(arena):
    """Asks for stills as a browser does for a page of another site, twenty times a second."""
    reader, writer = await arena.connect()
    try:
        for number in itertools.count():
            await ask_on(reader, writer, arena, f"/render?size=640x360&exposure={1 + arena.index + 1e-4 * number:.4f}",
                         "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: no-cors", "Sec-Fetch-Dest: image",
                         "Referer: https://elsewhere.example/")
            await asyncio.sleep(0.05)
    finally:
        writer.close()


@case(clients=64, seconds=8, needs=("begun", "modest"), newcomer=True, most={**JOINS, "rss_mb": 1500})
async def answers_unread(arena):
    """Each of 64 addresses asks for large pictures and reads nothing of them; another one still gets its own."""
    address = f"127.0.66.{arena.index + 1}"
    if arena.index == 0:
        await asyncio.sleep(4)
        while True:
            reader, writer = await arena.connect(address)
            await ask_on(reader, writer, arena, "/render?size=160x90")
            arena.heard["modest"] += 1
            writer.close()
            await asyncio.sleep(0.5)
    writers = []
    try:
        while True:  # all ask for the same, which is drawn once and held for each
            _, writer = await arena.connect(address)
            writers.append(writer)
            writer.transport.pause_reading()
            writer.write(b"GET /render?size=1280x720&format=exr HTTP/1.1\r\nHost: localhost\r\n\r\n")
            arena.heard["begun"] += 1
            await asyncio.sleep(1)
    finally:
        for writer in writers:
            writer.transport.abort()


@case(clients=400, seconds=6, newcomer=True, serve=("--max-connections", "128"), most={"newcomer_s": 2})
async def two_silent_addresses(arena):
    """Two addresses hold as many connections as there may be, each its half, and say nothing on them."""
    _, writer = await arena.connect(f"127.0.66.{1 + arena.index % 2}")
    try:
        await asyncio.sleep(NEVER)
    finally:
        writer.close()


@case(clients=40, seconds=6, needs=("live",), newcomer=True, most=JOINS)
async def silent_at_the_admin_address(arena):
    """Holds the admin address's connections and says nothing; an orchestrator's probe must be answered."""
    if arena.index > 0:
        _, writer = await arena.connect(arena.address, arena.admin_port)
        try:
            await asyncio.sleep(NEVER)
        finally:
            writer.close()
        return
    await asyncio.sleep(1.5)
    while True:
        reader, writer = await asyncio.wait_for(arena.connect("127.0.0.1", arena.admin_port), 2)
        try:
            await asyncio.wait_for(ask_on(reader, writer, arena, "/livez"), 2)
            arena.heard["live"] += 1
        finally:
            writer.close()
        await asyncio.sleep(0.2)


FORM = "Content-Type: multipart/form-data; boundary=x\r\n"
BROKEN_FORMS = (b"--x\r\n" * 1000, b"--x\r\n" + b"h" * 10_000 + b": 1\r\n\r\n",
                b'--x\r\nContent-Disposition: form-data; filename="../../a.glb"\r\n\r\nglTF\r\n--x--', b"--x--\r\n")


async def post(arena, body, size=None, address=None, fields=""):
    reader, writer = await arena.connect(*([address] if address else []))
    try:
        writer.write(f"POST /render?size=64x64 HTTP/1.1\r\nHost: localhost\r\n{fields}"
                     f"Content-Length: {len(body) if size is None else size}\r\n\r\n".encode() + body)
        head = await reader.readuntil(b"\r\n\r\n")
        status = int(head.split()[1])
        arena.heard[f"HTTP {status}"] += 1
        if status >= 400 and status != 429:  # of too many requests, whatever they want
            size = int(re.search(rb"(?i)content-length: (\d+)", head)[1])
            text = await reader.readexactly(size)
            assert b"application/json" in head, head + text
            assert json.loads(text)["message"].isprintable(), text
        return status
    except asyncio.IncompleteReadError:
        arena.heard["hung up"] += 1
        return None
    finally:
        writer.close()


@case(clients=8, seconds=10, needs=("HTTP 400",), newcomer=True, most=JOINS)
async def broken_scenes_posted(arena):
    """Posts two hundred files of six formats and four forms, all broken, as fast as they are refused."""
    bodies = [*(body for _, body in broken_files()), *BROKEN_FORMS]
    first = arena.index * len(bodies) // 8
    for body in itertools.cycle(bodies[first:] + bodies[:first]):
        await post(arena, body, fields=FORM if body in BROKEN_FORMS else "")


@case(clients=16, seconds=16, needs=("HTTP 408", "HTTP 200"), newcomer=True,
      serve=("--max-body", "8"), most={**JOINS, "rss_mb": 1500})
async def scenes_that_never_come(arena):
    """Announces scenes of the largest size and sends a byte of each; another address still gets its picture."""
    if arena.index == 0:
        scene = b'{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,"nodes":[{}]}'
        await asyncio.sleep(3)
        while True:
            assert await post(arena, scene, address="127.0.66.99") == 200
            await asyncio.sleep(0.5)
    while True:
        await post(arena, b"{", 8 << 20, f"127.0.66.{arena.index}")
        await asyncio.sleep(0.2)
