"""Drives a server by JSON alone: circles the camera for 3 s from the first
picture on. Usage: drive.py [URL]"""

import asyncio, itertools, json, math, sys, time

import websockets


async def drive(url="ws://127.0.0.1:8080/ws"):
    frames, seq, start, angle = 0, itertools.count(1), None, 0
    async with websockets.connect(url, subprotocols=["froxel.v1"], max_size=2**26) as socket:

        async def say(**command):
            await socket.send(json.dumps({"seq": next(seq), **command}))

        await say(hello={"protocolMajor": 1, "clientName": "drive.py"})
        while angle < 3:
            message = await asyncio.wait_for(socket.recv(), 60)
            if isinstance(message, str):
                print(*json.loads(message))  # welcome, state, error
                continue
            start = start or time.monotonic()
            angle = time.monotonic() - start
            # 4 bytes, then a FrameHeader in protobuf; its field 1: a tag, then 7 bits a byte.
            end = next(at for at in range(5, 15) if message[at] < 0x80)
            frame_id = sum((message[at] & 0x7F) << (7 * (at - 5)) for at in range(5, end + 1))
            await say(ack={"frameId": frame_id})
            eye = {"x": 8 * math.cos(angle), "y": 3, "z": 8 * math.sin(angle)}
            await say(setCamera={"eye": eye, "target": {"y": 2}})
            frames += 1
    print(f"{frames} frames")

asyncio.run(drive(*sys.argv[1:]))
