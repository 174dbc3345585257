"""What a hostile case is, and how it is played."""

import asyncio
import collections
import contextlib
import dataclasses
import importlib.util
import json
import multiprocessing
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import websockets

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[0] / "load"))
from server import Server, write_halls
from viewer import Viewer, Victim

# `froxel load` comes from 127.0.0.1.
HONEST, HOSTILE, NEWCOMER = "127.0.0.2", "127.0.0.66", "127.0.0.3"
SETTLED_FRAMES = 20
# However long a case is played, what the honest viewer has alone is known after this.
ALONE_S = 60
# A hostile viewer that was sent away comes back.
COMES_BACK_S = 0.05
NEVER = 60.0

LEAST = {"kept": 0.4}
MOST = {"gap_s": 0.5}


@dataclasses.dataclass
class Case:
    attack: Callable
    clients: int = 1  # how many of it at once
    seconds: float = 3  # beside the hostile ones; as long alone, but no longer than ALONE_S
    serve: tuple = ()  # options of froxel serve
    scenes: bool = False  # whether it has a folder of scenes, as made by fill()
    files: int = 0  # so many small files of scenes instead
    slow_files: int = 0  # besides: so many that take seconds to read
    token: str = ""  # that the server asks for; the honest viewer has it
    room: str = ""  # that the honest viewer is in; it came first
    needs: tuple = ()  # what the hostile viewers must have heard, lest it be no attack
    newcomer: bool = False  # whether another honest viewer comes at the end: newcomer_s
    least: dict = dataclasses.field(default_factory=dict)  # bounds of figures, besides LEAST and MOST
    most: dict = dataclasses.field(default_factory=dict)
    name: str = ""
    group: str = ""

    def missed(self, figures, slack):
        """The bounds that figures break by more than `slack` times, in words."""
        most = {**MOST, **self.most}
        if "ping_p99_ms" in most:  # where the machine itself takes longer, twice what it takes
            most["ping_p99_ms"] = max(most["ping_p99_ms"], 2 * figures["alone_ping_p99_ms"])
        for name, bound in {**LEAST, **self.least}.items():
            if figures[name] < bound / slack:
                yield f"{name} {figures[name]:.3g}, at least {bound / slack:.3g}"
        for name, bound in most.items():
            if figures[name] > bound * slack:
                yield f"{name} {figures[name]:.3g}, at most {bound * slack:.3g}"


CASES = {}


def case(**settings):
    """Decorates `async def NAME(arena)`, which behaves badly until it is cancelled."""

    def add(attack):
        CASES[attack.__name__] = Case(
            attack, name=attack.__name__, group=Path(attack.__code__.co_filename).stem, **settings)
        return attack

    return add


def load_cases():
    for file in sorted((HERE / "cases").glob("*.py")):
        spec = importlib.util.spec_from_file_location(f"hostile_{file.stem}", file)
        spec.loader.exec_module(importlib.util.module_from_spec(spec))


@dataclasses.dataclass
class Arena:
    """What a hostile viewer knows: the server's URL, the binary, and which of its kind it is."""

    url: str
    admin_port: int
    froxel: str
    index: int
    heard: collections.Counter
    address: str = HOSTILE

    def viewer(self, **hello):
        return Viewer(self.url, HOSTILE, self.heard, **hello)

    async def connect(self, address=HOSTILE, port=None):
        """(reader, writer) of a connection that has said nothing yet, from this address; to the viewers' port."""
        host, viewers_port = self.url.split("/")[2].rsplit(":", 1)
        return await asyncio.open_connection(host, port or int(viewers_port), local_addr=(address, 0))

    @contextlib.asynccontextmanager
    async def asking(self, path):
        """The reader of HTTP's answer once it has begun, whose status is heard. Hangs up at the end, however that
        comes."""
        reader, writer = await self.connect()
        try:
            writer.write(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
            status = await reader.readline()
            self.heard[f"HTTP {status.split()[1].decode()}" if status else "hung up"] += 1
            yield reader
        finally:
            writer.close()


async def attack_for_ever(attack, arena):
    while True:
        try:
            await attack(arena)
        except websockets.exceptions.ConnectionClosed as closed:
            arena.heard[f"closed {closed.rcvd.code if closed.rcvd else 1006}"] += 1
        except websockets.exceptions.InvalidStatusCode as refused:
            arena.heard[f"HTTP {refused.status_code}"] += 1
        except (OSError, asyncio.TimeoutError, websockets.exceptions.WebSocketException) as error:
            arena.heard[type(error).__name__] += 1
        await asyncio.sleep(COMES_BACK_S)


def play_hostile(name, url, admin_port, froxel, ready, begin, pipe):
    """In a process of its own, so that it does not slow the honest viewer's clock."""
    load_cases()
    case = CASES[name]
    heard = collections.Counter()

    async def play():
        arenas = (Arena(url, admin_port, froxel, index, heard) for index in range(case.clients))
        tasks = [asyncio.create_task(attack_for_ever(case.attack, arena)) for arena in arenas]
        over = asyncio.get_running_loop().run_in_executor(None, pipe.recv)
        done, _ = await asyncio.wait([over, *tasks], return_when=asyncio.FIRST_COMPLETED)
        if over not in done:
            await done.pop()  # raises what is wrong with the case
        for task in tasks:
            task.cancel()
        await asyncio.wait(tasks, timeout=1)
        pipe.send(heard)
        os._exit(0)  # nobody is owed a longer good-bye

    ready.set()
    begin.wait()
    asyncio.run(play())


def steps_of(server):
    """How many steps of frames took at most so many seconds, by what they do, as the server's histogram tells it."""
    text = server.scrape()
    steps = {}
    for step in ("begin", "piece"):
        buckets = re.findall(rf'^froxel_frame_step_seconds_bucket\{{step="{step}",le="(.*)"\}} (\d+)$', text, re.M)
        steps[step] = {bound: int(count) for bound, count in buckets}
    return steps


def longest_step_s(steps):
    """What no step took longer than."""
    return max(min(float(bound) for bound, count in counts.items() if count == counts["+Inf"])
               for counts in steps.values())


class Memory:
    """Most that the server held, read from its metrics meanwhile."""

    def __init__(self, server):
        self.server, self.rss, self.device, self.task = server, 0.0, 0.0, None

    async def __aenter__(self):
        self.task = asyncio.create_task(self.watch())
        return self

    async def __aexit__(self, *_):
        self.task.cancel()

    async def watch(self):
        while True:
            try:
                now = await asyncio.to_thread(self.server.sample)
                self.rss = max(self.rss, now["process_resident_memory_bytes"] / 1e6)
                self.device = max(self.device, now["froxel_device_memory_bytes"] / 1e6)
            except OSError:
                pass  # too busy to answer, or gone: the honest viewer tells
            await asyncio.sleep(0.5)


async def newcomer(url, token):
    """Seconds until an honest viewer that comes now has its first picture; it tries again and again."""
    begin = time.monotonic()
    while time.monotonic() < begin + NEVER:
        try:
            async with Victim(url, NEWCOMER, token=token) as viewer:
                while (await viewer.hear())[0] != "frame":
                    pass
                return time.monotonic() - begin
        except (OSError, asyncio.TimeoutError, websockets.exceptions.WebSocketException):
            await asyncio.sleep(0.5)
    return NEVER


async def measure(case, server, begin, fellow, alone):
    async with Victim(server.url, HONEST, room=case.room, token=case.token) as victim, Memory(server) as memory:
        running = asyncio.create_task(victim.run())
        await asyncio.sleep(0)
        while len(victim.frames) < SETTLED_FRAMES and not running.done():
            await asyncio.sleep(0.05)
        times, heard = [time.monotonic()], [collections.Counter(victim.heard)]
        for start, seconds in ((None, 0 if alone else min(case.seconds, ALONE_S)), (begin, case.seconds)):
            if start:
                start.set()
            await asyncio.wait([running], timeout=seconds)
            times.append(time.monotonic())
            heard.append(collections.Counter(victim.heard))
        joined = {"newcomer_s": await newcomer(server.url, case.token)} if case.newcomer else {}
        if running.done():
            await running  # raises what ended it
        running.cancel()
        steps = await asyncio.to_thread(steps_of, server)
    alone = alone or victim.figures(times[0], times[1])
    beside = victim.figures(times[1], times[2])
    room_states = (heard[2] - heard[1])["roomState"] / (times[2] - times[1])
    return {"alone": alone, **{f"alone_{name}": value for name, value in alone.items()}, **beside, **joined,
            "kept": beside["fps"] / max(alone["fps"], 1e-9), "room_states_per_s": room_states,
            "step_s": longest_step_s(steps), "steps": steps,
            "rss_mb": memory.rss, "device_mb": memory.device, "fellow_alive": fellow.is_alive()}


def served_with(options, own):
    """Options of froxel serve, without those that `own` has too, and then `own`."""
    groups = []  # a name and what follows it
    for word in options:
        if word.startswith("--") or not groups:
            groups.append([])
        groups[-1].append(word)
    return [word for group in groups if group[0] not in own for word in group] + list(own)


def fill(folder, froxel):
    """Four scenes that take a second to read, and one that cannot be read."""
    hall = write_halls(folder, froxel)
    (folder / "broken.glb").write_bytes(hall.read_bytes()[:100_000])


def slow_file():
    """Three million vertices without data, in triangles without normals."""
    count = 3_000_000
    return json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "accessors": [{"componentType": 5126, "type": kind, "count": count} for kind in ("VEC3", "VEC2", "VEC4")],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2}}]}]})


@contextlib.contextmanager
def served(case, froxel, options):
    """The server that a case is played with."""
    options = ["--drain-seconds", "1", *served_with(options, case.serve)]
    with tempfile.TemporaryDirectory() as folder:
        scenes = Path(folder) / "scenes"
        scenes.mkdir()
        if case.scenes:
            fill(scenes, froxel)
        for number in range(case.files):
            (scenes / f"{number:05}.gltf").write_text('{"asset": {"version": "2.0"}}')
        for number in range(case.slow_files):
            (scenes / f"slow{number}.gltf").write_text(slow_file())
        if case.scenes or case.files:
            options += ["--scenes", str(scenes)]
        if case.token:
            tokens = Path(folder) / "tokens"
            tokens.write_text(case.token + "\n")
            options += ["--token-file", str(tokens)]
        with Server(froxel, *options) as server:
            yield server


def play(case, froxel, options, slack, alone):
    """(figures, what is wrong) of one run with a server of its own. `alone`: the honest viewer's own figures, where
    they are known."""
    spawn = multiprocessing.get_context("spawn")
    ready, begin = spawn.Event(), spawn.Event()
    ours, theirs = spawn.Pipe()
    figures, wrong = {}, []
    with served(case, froxel, options) as server:
        admin_port = int(server.metrics_url.split("/")[2].rsplit(":", 1)[1])
        fellow = spawn.Process(target=play_hostile,
                               args=(case.name, server.url, admin_port, froxel, ready, begin, theirs), daemon=True)
        fellow.start()
        ready.wait(30)
        try:
            figures = asyncio.run(measure(case, server, begin, fellow, alone))
            wrong += case.missed(figures, slack)
            if not figures.pop("fellow_alive"):
                wrong.append("the hostile viewers ended by themselves")
        except (OSError, asyncio.TimeoutError, websockets.exceptions.WebSocketException) as error:
            wrong.append(f"the honest viewer was lost: {type(error).__name__} {error}")
        if server.process.poll() is not None:
            wrong.append(f"the server ended: {server.process.returncode}")
        if fellow.is_alive():
            ours.send("over")
            figures["heard"] = dict(ours.recv()) if ours.poll(10) else {}
            wrong += [f"no hostile viewer heard {name}" for name in case.needs if not figures["heard"].get(name)]
            fellow.terminate()
        fellow.join()
        code = server.stop()
        if code != 0 and not wrong:
            wrong.append(f"the server's exit code is {code}")
    return figures, wrong
