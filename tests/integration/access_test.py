#!/usr/bin/env python3
"""Tokens, TLS, reloading and configuration, from outside: access_test.py PATH_OF_FROXEL.

One server with a file, variables and a command line; the certificates are made by openssl.
"""

import asyncio
import json
import os
import signal
import ssl
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request
from pathlib import Path

import websockets.legacy.client  # the client that 10.4 (Debian 12) and 15 (Debian 13) share

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from viewer_protocol import make_certificate

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
OLD, NEW = "old-token-0123456789", "new-token-0123456789"


class Access(unittest.IsolatedAsyncioTestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        make_certificate(cls.folder / "cert.pem", cls.folder / "key.pem", "first")
        cls.tokens = cls.folder / "tokens"
        cls.tokens.write_text(f"# viewers\n{OLD}\n")
        config = cls.folder / "froxel.toml"
        config.write_text('size = "640x480"\nlights = 20\ndrain-seconds = 1\nmax-sessions = 9\n')
        cls.log = open(cls.folder / "log", "w+", encoding="utf-8")
        cls.addClassCleanup(cls.log.close)
        cls.server = subprocess.Popen(
            [FROXEL, "serve", "--config", config, "--device", "cpu", "--port", "0", "--min-fps", "0",
             "--tls-cert", cls.folder / "cert.pem", "--tls-key", cls.folder / "key.pem"],
            env={**os.environ, "FROXEL_TOKEN_FILE": str(cls.tokens), "FROXEL_MAX_SESSIONS": "3",
                 "FROXEL_ADMIN_BIND": "127.0.0.1:0", "FROXEL_SERVICE_HOST": "10.0.0.1"},
            stdout=subprocess.PIPE, stderr=cls.log, text=True)
        cls.addClassCleanup(cls.server.wait)
        cls.addClassCleanup(cls.server.kill)
        cls.addClassCleanup(cls.server.stdout.close)
        cls.url = cls.server.stdout.readline().strip()
        cls.admin = cls.server.stdout.readline().strip().removesuffix("metrics")

    def tearDown(self):
        """Says what a server that ended by itself has said: each later test fails for it."""
        if self.server.poll():
            self.log.seek(0)
            self.fail(f"the server ended with {self.server.returncode}:\n{self.log.read()[-3000:]}")

    def context(self, version=None):
        context = ssl.create_default_context(cafile=self.folder / "cert.pem")
        if version:
            context.minimum_version = context.maximum_version = version
        return context

    async def greet(self, **hello):
        """The connection, and the first Welcome or Error."""
        socket = await websockets.legacy.client.connect(self.url.replace("https", "wss") + "ws", ssl=self.context(),
                                          subprotocols=["froxel.v1"], max_size=2**26)
        await socket.send(json.dumps({"seq": 1, "hello": {"protocolMajor": 1, **hello}}))
        while True:
            answer = json.loads(await asyncio.wait_for(socket.recv(), 60))
            if "loading" not in answer:
                return socket, answer

    async def assert_refused(self, **hello):
        socket, answer = await self.greet(**hello)
        self.assertEqual(answer["error"]["code"], "ERROR_CODE_TOKEN")
        await asyncio.wait_for(socket.wait_closed(), 10)
        self.assertEqual(socket.close_code, 4003)

    async def assert_welcome(self, token):
        """Also that a picture comes."""
        socket, answer = await self.greet(token=token)
        self.assertIn("welcome", answer)
        while not isinstance(message := await asyncio.wait_for(socket.recv(), 60), bytes):
            pass
        header = int.from_bytes(message[2:4], "little")
        self.assertEqual(message[4 + header:][:2], b"\xff\xd8")
        await socket.close()

    async def hang_up(self, what):
        """Sends SIGHUP and waits for the log to say `what`."""
        self.log.seek(0, os.SEEK_END)
        begin = self.log.tell()
        self.server.send_signal(signal.SIGHUP)
        for _ in range(200):
            await asyncio.sleep(0.05)
            self.log.seek(begin)
            if what in self.log.read():
                return
        self.fail(f"no {what} in the log")

    async def test_1_token_is_asked_for(self):
        await self.assert_refused()
        await self.assert_refused(token=OLD + "x")
        await self.assert_refused(token=NEW)
        await self.assert_refused(resumeToken="00" * 32)
        await self.assert_welcome(OLD)

    def load(self, *options, url=None):
        """`froxel load` of two viewers."""
        return subprocess.run(
            [FROXEL, "load", url or self.url, "--viewers", "2", "--seconds", "1", *options],
            capture_output=True, text=True, timeout=90)

    def test_1_load_speaks_tls_and_shows_a_token(self):
        trusting = ("--tls-authorities", self.folder / "cert.pem")
        run = self.load("--token-file", self.tokens, *trusting)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("viewers: 2", run.stdout)
        for options, url, why in (
                (trusting, None, "token is missing"),
                (("--token-file", self.tokens), None, "self-signed certificate"),
                (trusting, self.url.replace("127.0.0.1", "localhost"), "hostname mismatch"),
                (trusting, "ws://127.0.0.1:9/", "--tls-authorities is for wss://")):
            run = self.load(*options, url=url)
            self.assertEqual(run.returncode, 2 if "is for" in why else 1, why)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(why, run.stderr)

    async def test_2_page_has_its_policy_and_asks_nobody(self):
        page = await asyncio.to_thread(urllib.request.urlopen, self.url + "healthz",
                                       context=self.context(), timeout=10)
        self.assertEqual(page.status, 200)
        self.assertIn("default-src 'self'", page.headers["Content-Security-Policy"])

    async def test_3_old_tls_and_no_tls_are_refused(self):
        port = int(self.url.rsplit(":", 1)[1].strip("/"))
        with self.assertRaises((websockets.exceptions.InvalidMessage, OSError)):
            await websockets.legacy.client.connect(f"ws://127.0.0.1:{port}/ws")
        run = subprocess.run(["openssl", "s_client", "-connect", f"127.0.0.1:{port}", "-tls1_1",
                              "-cipher", "ALL@SECLEVEL=0"], input="", capture_output=True, text=True,
                             timeout=30, check=False)
        self.assertNotEqual(run.returncode, 0)
        for version in (ssl.TLSVersion.TLSv1_2, ssl.TLSVersion.TLSv1_3):
            url = self.url + "healthz"
            answer = urllib.request.urlopen(url, context=self.context(version), timeout=10)
            self.assertEqual(answer.status, 200)

    async def test_4_hangup_reads_tokens_and_certificate_again(self):
        self.tokens.write_text(f"{OLD}\n{NEW}\n")
        await self.hang_up("event=reloaded what=tokens")
        (revoked, _), (kept, answer) = await self.greet(token=OLD), await self.greet(token=NEW)
        self.assertIn("welcome", answer)
        self.tokens.write_text(f"{NEW}\n")
        make_certificate(self.folder / "cert.pem", self.folder / "key.pem", "second")
        await self.hang_up("event=reloaded what=certificate")
        with self.assertRaises(websockets.exceptions.ConnectionClosed):
            while True:
                await asyncio.wait_for(revoked.recv(), 10)
        self.assertEqual((revoked.close_code, revoked.close_reason),
                         (4003, "the token was removed"))
        await asyncio.wait_for(await kept.ping(), 10)
        self.assertTrue(kept.open)
        await kept.close()
        await self.assert_welcome(NEW)
        await self.assert_refused(token=OLD)

    async def test_5_broken_files_change_nothing(self):
        self.tokens.write_text("short\n")
        await self.hang_up("event=not_reloaded what=tokens")
        await self.assert_welcome(NEW)

    async def test_6_probe_tells_the_verdict_by_its_exit_code(self):
        for path, code in (("readyz", 0), ("livez", 0), ("startupz", 0), ("nothing", 1)):
            run = subprocess.run([FROXEL, "probe", self.admin + path], capture_output=True, text=True,
                                 timeout=20, check=False)
            self.assertEqual((run.returncode, len(run.stdout.splitlines())), (code, 1), run)
        run = subprocess.run([FROXEL, "probe", "http://127.0.0.1:1/livez"], capture_output=True,
                             text=True, timeout=20, check=False)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(len(run.stderr.splitlines()), 1)

    async def test_7_drains_and_the_log_has_the_configuration_and_no_token(self):
        socket, _ = await self.greet(token=NEW)
        self.server.send_signal(signal.SIGTERM)
        with self.assertRaises(websockets.exceptions.ConnectionClosed):
            while True:
                await asyncio.wait_for(socket.recv(), 10)
        self.assertEqual(socket.close_code, 4010)
        self.assertEqual(await asyncio.to_thread(self.server.wait, 10), 0)
        self.log.seek(0)
        log = self.log.read()
        self.assertRegex(log, "event=configuration from=file .*drain-seconds=1")
        self.assertRegex(log, "event=configuration from=environment .*max-sessions=3")
        self.assertRegex(log, "event=configuration from=command_line .*device=cpu")
        self.assertRegex(log, "event=configuration from=default .*watchdog-seconds=")
        self.assertIn("event=unknown_variable name=FROXEL_SERVICE_HOST", log)
        self.assertNotIn(OLD, log)
        self.assertNotIn(NEW, log)


class Beginning(unittest.TestCase):
    """Servers that end as they begin."""

    def serve(self, *options, **process):
        return subprocess.run([FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind", "none", *options],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, **process)

    def test_stop_signal_that_came_before_it_could_be_caught(self):
        """As the first process of a container gets it."""
        def hold_and_send():
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
            os.kill(os.getpid(), signal.SIGTERM)
        ended = self.serve("--drain-seconds", "1", preexec_fn=hold_and_send)
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_encrypted_key_is_refused_and_not_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            certificate, key, encrypted = (Path(folder) / name for name in ("cert.pem", "key.pem", "encrypted.pem"))
            make_certificate(certificate, key, "first")
            subprocess.run(["openssl", "pkey", "-in", key, "-aes256", "-passout", "pass:secret", "-out", encrypted],
                           check=True, capture_output=True)
            ended = self.serve("--tls-cert", certificate, "--tls-key", encrypted)
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertIn("encrypted.pem: is encrypted; expected a key without a passphrase", ended.stderr)


if __name__ == "__main__":
    unittest.main()
