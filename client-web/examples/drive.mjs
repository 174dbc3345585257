// Drives a server by JSON alone: circles the camera for 3 s. Usage: node drive.mjs [URL]

import WebSocket from 'ws';

const socket = new WebSocket(process.argv[2] ?? 'ws://127.0.0.1:8080/ws', 'froxel.v1');
let seq = 0;
let frames = 0;
const say = (command) => socket.send(JSON.stringify({ seq: (seq += 1), ...command }));

/** 4 bytes, then a FrameHeader in protobuf; its field 1: a tag, then 7 bits a byte. */
function frameId(message) {
  if (message.readUInt16BE() !== 0xf701 || message[4] !== 0x08) throw new Error('not a frame');
  const bytes = message.subarray(5, message.findIndex((byte, at) => at > 4 && byte < 0x80) + 1);
  return bytes.reduceRight((id, byte) => id * 128 + (byte & 0x7f), 0);
}

socket.on('open', () => say({ hello: { protocolMajor: 1, clientName: 'drive.mjs' } }));
socket.on('message', (message, isBinary) => {
  // "welcome", "state", "error"
  if (!isBinary) return console.log(...Object.keys(JSON.parse(message.toString())));
  frames += 1;
  if (frames === 1) setTimeout(() => socket.close(), 3000);
  say({ ack: { frameId: frameId(message) } });
  const angle = process.uptime();
  const eye = { x: 8 * Math.cos(angle), y: 3, z: 8 * Math.sin(angle) };
  say({ setCamera: { eye, target: { y: 2 } } });
});
socket.on('error', (error) => console.error(error.message));
socket.on('close', () => console.log(`${frames} frames`));
