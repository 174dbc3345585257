"""Runs the commands of README and of the tutorials, as a reader pastes them.

Usage: tutorials_test.py ROOT FROXEL [unittest's arguments]. Blocks marked `sh` run in one shell, in a folder like a fresh
clone whose build scripts find FROXEL built already. A block marked `sh server` is a server in another terminal: the
one before is stopped, and this one must become ready. `sh scripts` names scripts that must be there, and `sh build`
compiles: neither is run. Ports and /tmp are replaced by ones of this run.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from ports import free_port

ROOT, FROXEL = (Path(path).resolve() for path in sys.argv[1:3])
SECONDS = 300
BLOCK = re.compile(r"^```sh ?(\w*)\n(.*?)^```$", re.M | re.S)
NOT_COPIED = shutil.ignore_patterns(".git", "build", "dist", "gen", "node_modules", "test-results", "__pycache__")
STUBS = {
    "build.sh": 'mkdir -p build/release && ln -sf "$FROXEL" build/release/froxel',
    "run.sh": 'exec "$FROXEL" serve --device cpu "$@"',
    "test.sh": 'test -x "$FROXEL"',
}
PROLOGUE = """
set -euo pipefail
server=
stop_server() { if [[ -n $server ]]; then kill -INT "$server" 2>/dev/null || true; wait "$server" || true; server=; fi; }
trap stop_server EXIT
wait_ready() {
    until curl -fs "http://127.0.0.1:$ADMIN_PORT/readyz" >/dev/null; do
        kill -0 "$server" # ends the run where the server has ended
        sleep 0.1
    done
    curl -fs -o /dev/null "http://127.0.0.1:$PAGE_PORT/"
}
"""


def blocks(page):
    """(kind, commands) of each block of shell commands of a page."""
    return BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))


def clone_into(folder):
    """Copies the repository's files as they are now, with build scripts that build nothing."""
    shutil.copytree(ROOT, folder, ignore=NOT_COPIED, dirs_exist_ok=True)
    for command in (["init", "-q"], ["add", "-A"]):
        subprocess.run(["git", *command], cwd=folder, check=True)
    for name, commands in STUBS.items():
        (folder / "deploy" / name).write_text(f"#!/usr/bin/env bash\n{commands}\n")
    (folder / "build").mkdir()
    (folder / "build/test").symlink_to(FROXEL.parent)


def script_of(page, temporary, ports, before, after):
    """The shell script of a page's blocks, with commands before and after them."""
    lines = [PROLOGUE, before]
    for kind, commands in blocks(page):
        for port, here in ports.items():
            commands = re.sub(rf"\b{port}\b", here, commands)
        commands = commands.replace("/tmp/", f"{temporary}/")
        if kind == "server":
            lines.append(f"stop_server\n{commands.strip()} &\nserver=$!\nwait_ready\n")
        elif not kind:
            lines.append(commands)
    return "\n".join([*lines, after])


class Tutorials(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.clone = tempfile.TemporaryDirectory()
        clone_into(Path(cls.clone.name))

    @classmethod
    def tearDownClass(cls):
        cls.clone.cleanup()

    def run_page(self, page, before="", after=""):
        with tempfile.TemporaryDirectory() as temporary:
            ports = {"8080": str(free_port()), "9090": str(free_port())}
            environment = {**os.environ, "FROXEL": str(FROXEL), "FROXEL_PORT": ports["8080"],
                           "FROXEL_ADMIN_BIND": f"127.0.0.1:{ports['9090']}", "PAGE_PORT": ports["8080"],
                           "ADMIN_PORT": ports["9090"]}
            script = script_of(page, temporary, ports, before, after)
            shell = subprocess.Popen(["bash", "-c", script], cwd=self.clone.name, env=environment, text=True, errors="replace",
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
            try:
                said, _ = shell.communicate(timeout=SECONDS)
            except subprocess.TimeoutExpired:
                os.killpg(shell.pid, signal.SIGKILL)
                said, _ = shell.communicate()
                self.fail(f"{page}: not done within {SECONDS} s:\n{said[-3000:]}")
            self.assertEqual(shell.returncode, 0, f"{page}:\n{said[-3000:]}")
            return said

    def test_scripts_that_pages_name_are_there(self):
        for page in ("README.md", *(str(path.relative_to(ROOT)) for path in (ROOT / "docs/tutorials").glob("*.md"))):
            for script in re.findall(r"^\./(\S+)", "\n".join(text for _, text in blocks(page)), re.M):
                self.assertTrue(os.access(ROOT / script, os.X_OK), f"{page}: {script}")

    def test_readme(self):
        self.run_page("README.md", "./deploy/build.sh\n./deploy/run.sh &\nserver=$!\nwait_ready\n")

    def test_view_a_model(self):
        self.assertIn("triangles", self.run_page("docs/tutorials/view-a-model.md"))

    def test_run_a_server(self):
        # The page ends the server itself: a signal while it drains would cut the drain short.
        said = self.run_page("docs/tutorials/run-a-server.md", after='wait "$server"\nserver=\n')
        self.assertIn("ready", said)
        self.assertIn("froxel_session", said)
        self.assertIn("event=drained", said)

    def test_write_a_client(self):
        self.assertIn("frame 3: ", self.run_page("docs/tutorials/write-a-client.md"))

    def test_change_the_code(self):
        self.assertIn("PASSED", self.run_page("docs/tutorials/change-the-code.md"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
