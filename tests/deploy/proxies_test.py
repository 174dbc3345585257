#!/usr/bin/env python3
"""Two servers behind the proxies of deploy/: proxies_test.py PATH_OF_FROXEL [--idle SECONDS]
[--rounds COUNT] [--viewers COUNT].

nginx and HAProxy are processes of this user, on free ports, with the files of deploy/ but for names,
ports and certificates. Viewers are lavapipe's smallest.
"""

import asyncio
import contextlib
import http.client
import http.server
import json
import os
import random
import re
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import websockets.legacy.client  # the client that 10.4 (Debian 12) and 15 (Debian 13) share

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import told_skips
from ports import free_port
from viewer_protocol import frame_id, make_certificate

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"


def option(name, default):
    if name not in sys.argv:
        return default
    at = sys.argv.index(name)
    value = float(sys.argv[at + 1])
    del sys.argv[at:at + 2]
    return value


IDLE_S = option("--idle", 0.0)
ROUNDS = int(option("--rounds", 1))  # of one server drained and started anew, the other killed
VIEWERS = int(option("--viewers", 6))
# From SIGKILL of its server to a viewer's first picture from the other one, with the page's backoff.
LONGEST_OUTAGE_S = 3.0
# What as many take to their first pictures without a proxy; where they take longer, the machine is starved and
# everything may take as many times longer.
DIRECT_S = 0.5
SCENE = Path(__file__).with_name("triangle.gltf")  # its light moves, so that frames come; made at once
DEPLOY = Path(__file__).resolve().parents[2] / "deploy"
os.environ["PATH"] += ":/usr/sbin"


def listens(port):
    with socket.socket() as caller:
        return caller.connect_ex(("127.0.0.1", port)) == 0


class Server:
    """One `froxel serve`, on ports that stay the same when it is started anew."""

    def __init__(self, *options):
        self.port, self.admin = free_port(), free_port()
        # Room for all viewers twice: nginx may send nearly everybody to one server.
        self.options = options or ("--max-sessions", "100")
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            [FROXEL, "serve", "--device", "cpu", "--scene", SCENE, "--size", "32x32", "--lights", "1", "--min-fps", "0",
             "--port", str(self.port), "--admin-bind", f"127.0.0.1:{self.admin}",
             "--drain-seconds", "3", "--log-level", "error", *self.options], stdout=subprocess.DEVNULL)

    def wait_ready(self):
        for _ in range(600):
            probe = subprocess.run([FROXEL, "probe", f"http://127.0.0.1:{self.admin}/readyz"],
                                   capture_output=True, check=False)
            if probe.returncode == 0:
                return
            time.sleep(0.1)
        raise AssertionError("a server is not ready after a minute")

    def metric(self, name):
        with socket.create_connection(("127.0.0.1", self.admin)) as connection:
            connection.sendall(b"GET /metrics HTTP/1.0\r\n\r\n")
            text = b"".join(iter(lambda: connection.recv(65536), b"")).decode()
        return float(re.search(rf"^{name} (\S+)", text, re.M)[1])

    def end(self):
        self.process.kill()
        self.process.wait()


class Viewer:
    """Keeps a session as the page does: comes back when its connection is lost or sent away."""

    def __init__(self, url, seed):
        self.url = url
        self.random = random.Random(seed)
        self.refused = 0        # connections that became no session
        self.frames = 0
        self.returns = []       # when the first picture of each later connection came
        self.pictured = False   # in this connection
        self.cookie = ""
        self.task = asyncio.create_task(self.run())

    async def run(self):
        trust = None
        if self.url.startswith("wss:"):
            trust = trusting()
        attempt = 0
        while True:
            try:
                headers = {"Cookie": self.cookie} if self.cookie else {}
                async with websockets.legacy.client.connect(self.url, ssl=trust, subprotocols=["froxel.v1"],
                                              extra_headers=headers, max_size=2**26) as connection:
                    given = connection.response_headers.get("Set-Cookie")
                    self.cookie = given.split(";")[0] if given else self.cookie
                    if await self.watch(connection):
                        attempt = 0
                        continue  # sent away: at once
            except (OSError, asyncio.TimeoutError, websockets.exceptions.WebSocketException) as error:
                if not isinstance(error, websockets.exceptions.ConnectionClosed):
                    self.refused += 1
            # As client-web/src/protocol/backoff.ts.
            attempt = 0 if self.pictured else attempt + 1
            self.pictured = False
            await asyncio.sleep(self.random.uniform(0.5, min(10, 2 ** attempt)))

    async def watch(self, connection):
        """Whether the server sent it away."""
        await connection.send(json.dumps({"seq": 1, "hello": {"protocolMajor": 1}}))
        seq = 1
        self.pictured = False
        with contextlib.suppress(websockets.exceptions.ConnectionClosed):
            async for message in connection:
                if isinstance(message, str):
                    if "draining" in json.loads(message):
                        return True
                    continue
                if not self.pictured and self.frames > 0:
                    self.returns.append(time.monotonic())
                self.pictured = True
                self.frames += 1
                seq += 1
                await connection.send(json.dumps({"seq": seq, "ack": {"frameId": frame_id(message)}}))
        return False


def trusting():
    """Of the test's own certificate."""
    trust = ssl.create_default_context()
    trust.check_hostname, trust.verify_mode = False, ssl.CERT_NONE
    return trust


class Session:
    """One connection that holds a session, without looking at it."""

    async def open(self, url, before=None, room="", headers=None):
        """Comes back to the session of `before`, if it is given."""
        query = f"?resume={before.token[:16]}" if before else f"?room={room}" if room else ""
        headers = headers or ({"Cookie": before.cookie} if before and before.cookie else {})
        self.connection = await websockets.legacy.client.connect(
            url + query, ssl=trusting() if url.startswith("wss:") else None, extra_headers=headers,
            subprotocols=["froxel.v1"], max_size=2**26)
        given = self.connection.response_headers.get("Set-Cookie")
        self.cookie = given.split(";")[0] if given else before.cookie if before else ""
        token = {"resumeToken": before.token} if before else {}
        await self.connection.send(json.dumps({"seq": 1, "hello": {"protocolMajor": 1, "room": room, **token}}))
        while "welcome" not in (message := await self.connection.recv()):
            pass
        self.welcome = json.loads(message)["welcome"]
        self.token = self.welcome["resumeToken"]
        self.members = self.welcome.get("room", {}).get("memberCount", 0)
        return self

    def cut(self):
        self.connection.transport.abort()


class SignIn:
    """What nginx asks of an oauth2-proxy: /oauth2/auth by its cookie, and a page to sign in."""

    def __init__(self):
        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                good = "_oauth2_proxy=good" in self.headers.get("Cookie", "")
                self.send_response(200 if self.path.startswith("/oauth2/start") else 202 if good else 401)
                self.send_header("Content-Length", "0")
                self.end_headers()

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.port = self.server.server_port
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def end(self):
        self.server.shutdown()
        self.server.server_close()


def fetch(port, path, headers):
    """Status and Location of a GET over TLS."""
    connection = http.client.HTTPSConnection("127.0.0.1", port, context=trusting(), timeout=20)
    with contextlib.closing(connection):
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        answer.read()
        return answer.status, answer.headers.get("Location", "")


async def eventually(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it never came"
        await asyncio.sleep(0.05)


class Proxies(unittest.IsolatedAsyncioTestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        make_certificate(cls.folder / "tls.crt", cls.folder / "tls.key", "localhost")
        key, certificate = ((cls.folder / name).read_text() for name in ("tls.key", "tls.crt"))
        (cls.folder / "tls.pem").write_text(certificate + key)
        cls.servers = [Server(), Server()]
        for server in cls.servers:
            cls.addClassCleanup(server.end)
        for server in cls.servers:
            server.wait_ready()

    def start_proxy(self, name, command, servers=None):
        """The file of deploy/ with our addresses; the proxy's URL."""
        port = free_port()
        text = (DEPLOY / name).read_text().replace("/etc/froxel", str(self.folder))
        text = text.replace("/run/nginx.pid", str(self.folder / "nginx.pid")).replace("8443", str(port))
        first, second = servers or self.servers
        for label, server in (("a", first), ("b", second)):
            text = text.replace(f"froxel-{label}:8080", f"127.0.0.1:{server.port}")
        # Two servers on one address: each has an admin port of its own.
        text = text.replace("check port 9090 ", "check ")
        for label, server in (("a", first), ("b", second)):
            text = text.replace(f"cookie {label}\n", f"cookie {label} port {server.admin}\n")
        path = self.folder / name
        path.write_text(text)
        proxy = subprocess.Popen([*command, str(path)], stderr=subprocess.DEVNULL)
        self.addCleanup(proxy.wait)
        self.addCleanup(proxy.terminate)
        return f"wss://127.0.0.1:{port}/ws", port

    async def check(self, url, port):
        await eventually(lambda: listens(port))
        viewers = [Viewer(url, seed) for seed in range(VIEWERS)]
        try:
            first, second = self.servers
            # nginx spreads by a hash, so even many may come to one server.
            while not await self.are_spread(viewers) and len(viewers) < VIEWERS + 24:
                viewers.append(Viewer(url, len(viewers)))
            self.assertTrue(await self.are_spread(viewers), "one server has everybody")
            await asyncio.sleep(IDLE_S)
            self.assertEqual([viewer.returns for viewer in viewers if viewer.returns], [])

            for _ in range(ROUNDS):
                await self.roll(first, viewers)
                self.assertEqual(sum(viewer.refused for viewer in viewers), 0)
                await self.kill(second, first, viewers)
        finally:
            await self.leave(viewers)

    async def check_full(self, name, command):
        """One server is full, the other empty: who is new gets in, who was cut comes back to its own."""
        # Nobody here looks at pictures; that must not make room.
        full = Server("--max-sessions", "3", "--paused-seconds", "1000")
        empty = Server("--max-sessions", "40", "--paused-seconds", "1000")
        for server in (full, empty):
            self.addCleanup(server.end)
        for server in (full, empty):
            await asyncio.to_thread(server.wait_ready)
        url, port = self.start_proxy(name, command, (full, empty))
        await eventually(lambda: listens(port))
        await asyncio.sleep(2.5)  # HAProxy knows who is well
        held = []
        while full.metric("froxel_viewers") == 0:
            self.assertLess(len(held), 30, "the proxy sends nobody to the first server")  # nginx: once in 2^30 runs
            held.append(await Session().open(url))
        cut = held[-1]
        while full.metric("froxel_sessions") < 3:
            held.append(await Session().open(f"ws://127.0.0.1:{full.port}/ws"))

        before = empty.metric("froxel_viewers")
        for _ in range(8):
            held.append(await Session().open(url))
        self.assertEqual(empty.metric("froxel_viewers"), before + 8)
        self.assertEqual(full.metric("froxel_sessions"), 3)

        cut.cut()
        await eventually(lambda: full.metric("froxel_viewers") == 2)
        back = await Session().open(url, cut)
        self.assertTrue(back.welcome.get("resumed"))
        self.assertEqual(full.metric("froxel_viewers"), 3)
        # Who sits at the second server by way of the first one's refusal comes back there, too.
        last = held[-1]
        last.cut()
        await eventually(lambda: empty.metric("froxel_viewers") == before + 7)
        self.assertTrue((await Session().open(url, last)).welcome.get("resumed"))

    async def check_rooms(self, name, command, comes_back_to):
        """Viewers of one room meet, whichever path they take, and whatever happens to its server.

        comes_back_to: whether a room that moved stays where it is when its first server is back.
        """
        servers = [Server("--max-sessions", "40"), Server("--max-sessions", "40")]
        for server in servers:
            self.addCleanup(server.end)
        for server in servers:
            await asyncio.to_thread(server.wait_ready)
        url, port = self.start_proxy(name, command, servers)
        await eventually(lambda: listens(port))
        await asyncio.sleep(2.5)  # HAProxy knows who is well
        page = url.replace("/ws", "/rooms/ws")  # as the page connects

        # The proxy hashes names over servers whose ports differ at each run: eight names share one server once in
        # 128 runs, 40 once in 2^39.
        def sessions():
            return [server.metric("froxel_sessions") for server in servers]

        rooms = []
        while len(rooms) < 8 or min(sessions()) == 0:
            self.assertLess(len(rooms), 40, "rooms are spread")
            rooms.append(f"room-{len(rooms)}")
            for address in (url, page, url):
                await Session().open(address, room=rooms[-1])
        self.assertEqual(sum(sessions()), len(rooms), "each room is on one server alone")
        self.assertEqual(sum(server.metric("froxel_viewers") for server in servers), 3 * len(rooms))

        # A server ends: everybody of its rooms meets on the other one.
        servers[0].end()
        await asyncio.sleep(2.5)
        survivors = [await Session().open(page, room=room) for room in rooms for _ in range(2)]
        self.assertEqual(servers[1].metric("froxel_sessions"), len(rooms))
        self.assertEqual(min(session.members for session in survivors[1::2]), 2)
        if comes_back_to:
            servers[0].start()
            await asyncio.to_thread(servers[0].wait_ready)
            await asyncio.sleep(2.5)
            for room in rooms:
                await Session().open(page, room=room)
            self.assertEqual(servers[0].metric("froxel_sessions"), 0)

    async def leave(self, viewers):
        for viewer in viewers:
            viewer.task.cancel()
        await asyncio.gather(*(viewer.task for viewer in viewers), return_exceptions=True)

    async def are_spread(self, viewers):
        await eventually(lambda: all(viewer.frames > 1 for viewer in viewers), 60)
        shares = [server.metric("froxel_viewers") for server in self.servers]
        self.assertEqual(sum(shares), len(viewers))
        return min(shares) > 0

    async def roll(self, server, viewers):
        """Ends one in order: its viewers are sent to the other, and nobody is refused."""
        await self.returned(viewers, server, lambda: server.process.send_signal(signal.SIGTERM))
        self.assertEqual(await asyncio.to_thread(server.process.wait, 20), 0)
        await self.start(server)

    async def kill(self, server, other, viewers):
        """Its viewers are back soon, on the other."""
        await self.direct(other, 1)  # the first one waits for what later ones find compiled
        count = int(server.metric("froxel_viewers"))
        direct = await self.direct(other, count)
        begin = time.monotonic()
        returns = await self.returned(viewers, server, server.process.kill)
        server.process.wait()
        outages = [at - begin for at in returns]
        direct = max(direct, await self.direct(other, count))
        print(f"{len(outages)} outages after SIGKILL: {min(outages):.2f} to {max(outages):.2f} s; as many directly: "
              f"{direct:.2f} s")
        self.assertLess(max(outages), LONGEST_OUTAGE_S * max(1, direct / DIRECT_S))
        await self.start(server)

    async def direct(self, server, count):
        """How long as many viewers take to their first pictures, without a proxy."""
        begin = time.monotonic()
        viewers = [Viewer(f"ws://127.0.0.1:{server.port}/ws", 0) for _ in range(count)]
        await eventually(lambda: all(viewer.frames > 0 for viewer in viewers), 60)
        took = time.monotonic() - begin
        await self.leave(viewers)
        return took

    async def returned(self, viewers, server, end):
        """When each viewer of the server had a picture again after its end."""
        before = [len(viewer.returns) for viewer in viewers]
        moved = server.metric("froxel_viewers")
        self.assertGreater(moved, 0)
        end()
        await eventually(lambda: sum(len(viewer.returns) for viewer in viewers) >= sum(before) + moved)
        return [at for viewer, count in zip(viewers, before) for at in viewer.returns[count:]]

    async def start(self, server):
        server.start()
        await asyncio.to_thread(server.wait_ready)
        await asyncio.sleep(2.5)  # HAProxy looks again within 2 s

    async def test_nginx(self):
        if not shutil.which("nginx"):
            self.skipTest("nginx is not here (Debian: nginx-light)")
        await self.check(*self.start_proxy("nginx.conf", ["nginx", "-g", "daemon off;", "-c"]))

    async def test_nginx_full_server(self):
        if not shutil.which("nginx"):
            self.skipTest("nginx is not here (Debian: nginx-light)")
        await self.check_full("nginx.conf", ["nginx", "-g", "daemon off;", "-c"])

    async def test_haproxy_full_server(self):
        if not shutil.which("haproxy"):
            self.skipTest("haproxy is not here (Debian: haproxy)")
        await self.check_full("haproxy.cfg", ["haproxy", "-db", "-f"])

    async def test_nginx_sign_in(self):
        """Only who is signed in gets the page, the API and a WebSocket."""
        if not shutil.which("nginx"):
            self.skipTest("nginx is not here (Debian: nginx-light)")
        sign_in = SignIn()
        self.addCleanup(sign_in.end)
        text = (DEPLOY / "nginx.signin.conf").read_text()
        (self.folder / "nginx.signin.conf").write_text(text.replace("oauth2-proxy:4180", f"127.0.0.1:{sign_in.port}"))
        self.addCleanup((self.folder / "nginx.signin.conf").unlink)
        url, port = self.start_proxy("nginx.conf", ["nginx", "-g", "daemon off;", "-c"])
        await eventually(lambda: listens(port))
        signed_in = {"Cookie": "_oauth2_proxy=good"}
        for path in ("/", "/healthz", "/settings.json"):
            status, location = await asyncio.to_thread(fetch, port, path, {})
            self.assertEqual(status, 302, path)
            self.assertIn("/oauth2/start?rd=https://", location)
            self.assertEqual((await asyncio.to_thread(fetch, port, path, signed_in))[0], 200, path)
        self.assertEqual((await asyncio.to_thread(fetch, port, "/oauth2/start?rd=/", {}))[0], 200)
        self.assertEqual((await asyncio.to_thread(fetch, port, "/oauth2/auth", {}))[0], 404, "nginx' own question")
        with self.assertRaises(websockets.exceptions.InvalidStatusCode) as refused:
            await Session().open(url)
        self.assertEqual(refused.exception.status_code, 401)
        await Session().open(url, headers=signed_in)

    async def test_nginx_rooms(self):
        if not shutil.which("nginx"):
            self.skipTest("nginx is not here (Debian: nginx-light)")
        await self.check_rooms("nginx.conf", ["nginx", "-g", "daemon off;", "-c"], comes_back_to=False)

    async def test_haproxy_rooms(self):
        if not shutil.which("haproxy"):
            self.skipTest("haproxy is not here (Debian: haproxy)")
        await self.check_rooms("haproxy.cfg", ["haproxy", "-db", "-f"], comes_back_to=True)

    async def test_haproxy(self):
        if not shutil.which("haproxy"):
            self.skipTest("haproxy is not here (Debian: haproxy)")
        await self.check(*self.start_proxy("haproxy.cfg", ["haproxy", "-db", "-f"]))


if __name__ == "__main__":
    told_skips.main()
