"""Drives a server by JSON alone: circles the camera for 3 s. Usage: drive.py [URL]"""

import asyncio
import json
import math
import sys
import time

import websockets


def frame_id(message):  # 4 bytes, then a FrameHeader in protobuf; its field 1: a tag, 7 bits a byte
    assert message[:2] == b"\xf7\x01" and message[4] == 0x08, message[:5]
    end = next(place for place in range(5, 15) if message[place] < 0x80)
    return sum((message[place] & 0x7F) << (7 * (place - 5)) for place in range(5, end + 1))


async def drive(url):
    frames, seq, start = 0, 0, time.monotonic()
    async with websockets.connect(url, subprotocols=["froxel.v1"], max_size=2**26) as socket:

        async def say(**command):
            nonlocal seq
            seq += 1
            await socket.send(json.dumps({"seq": seq, **command}))

        await say(hello={"protocolMajor": 1, "clientName": "drive.py"})
        while (angle := time.monotonic() - start) < 3:
            message = await asyncio.wait_for(socket.recv(), 60)
            if isinstance(message, str):  # JSON: Welcome, StateChanged, Error
                print(*json.loads(message))
                continue
            frames += 1
            await say(ack={"frameId": frame_id(message)})
            eye = {"x": 8 * math.cos(angle), "y": 3, "z": 8 * math.sin(angle)}
            await say(setCamera={"eye": eye, "target": {"y": 2}})
    print(f"{frames} frames")


asyncio.run(drive(sys.argv[1] if len(sys.argv) > 1 else "ws://127.0.0.1:8080/ws"))
