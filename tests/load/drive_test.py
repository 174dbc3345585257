"""The Python example drives a server.

Usage: drive_test.py FROXEL.
"""

import re
import subprocess
import sys
from pathlib import Path


def main(froxel):
    command = [froxel, "serve", "--port", "0", "--admin-bind", "none"]
    command += ["--device", "cpu", "--size", "160x90"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            url = server.stdout.readline().strip().replace("http://", "ws://") + "ws"
            example = [sys.executable, Path(__file__).with_name("drive.py"), url]
            run = subprocess.run(example, capture_output=True, text=True, timeout=90, check=True)
        finally:
            server.terminate()
    assert server.returncode == 0, server.returncode
    *said, end = run.stdout.splitlines()
    assert {"welcome", "state"} <= set(said) and "error" not in said, said
    frames = re.fullmatch(r"(\d+) frames", end)
    # The server sends two without acknowledgements.
    assert frames and int(frames[1]) > 2, end


main(sys.argv[1])
