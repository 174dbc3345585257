"""A viewer in another language: JSON over WebSocket, nothing of ours but the schema's names.

Usage: json_client.py FROXEL. Starts `FROXEL serve`, changes some things, checks what comes back.
"""

import asyncio
import json
import subprocess
import sys

import websockets


async def view(url):
    async with websockets.connect(url, subprotocols=["froxel.v1"], max_size=2**26) as socket:
        seq = 0

        async def say(**body):
            nonlocal seq
            seq += 1
            await socket.send(json.dumps({"seq": str(seq), "clientTimeUs": "0", **body}))

        async def hear(kind):
            while True:
                message = await asyncio.wait_for(socket.recv(), 60)
                if isinstance(message, bytes):  # a frame: magic, kind, length, header, JPEG
                    assert message[0] == 0xF7 and message[1] == 1, message[:4]
                    start = 4 + int.from_bytes(message[2:4], "little")
                    if kind == "frame":
                        return message[start:]
                elif kind in json.loads(message):
                    return json.loads(message)[kind]

        await say(hello={"protocolMajor": 1, "clientName": "json_client.py"})
        welcome = await hear("welcome")
        assert welcome["scene"]["cameras"], welcome
        jpeg = await hear("frame")
        assert jpeg[:2] == b"\xff\xd8" and jpeg[-2:] == b"\xff\xd9", jpeg[:16]

        await say(setRenderer={"renderer": "RENDERER_NAIVE"})
        state = (await hear("state"))["state"]
        assert state["renderer"] == "RENDERER_NAIVE", state
        await say(setExposure={"exposure": "NaN"})
        error = await hear("error")
        assert error["code"] == "ERROR_CODE_OUT_OF_RANGE" and error["field"] == "exposure", error


def main(froxel):
    command = [froxel, "serve", "--port", "0", "--admin-bind", "none"]
    command += ["--device", "cpu", "--size", "160x90"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            url = server.stdout.readline().strip().replace("http://", "ws://") + "ws"
            asyncio.run(view(url))
        finally:
            server.terminate()
    assert server.returncode == 0, server.returncode


main(sys.argv[1])
