"""A viewer that speaks JSON, for the tests beside this file."""

import asyncio
import json

import websockets.legacy.client  # the client that 10.4 (Debian 12) and 15 (Debian 13) share


async def join(url):
    """A connection that has been welcomed and has had a picture."""
    socket = await websockets.legacy.client.connect(url, subprotocols=["froxel.v1"], max_size=2**26)
    await socket.send(json.dumps({"seq": 1, "hello": {"protocolMajor": 1}}))
    welcomed = False
    while not isinstance(message := await asyncio.wait_for(socket.recv(), 60), bytes):
        welcomed = welcomed or "welcome" in json.loads(message)
    assert welcomed
    return socket
