"""What tests' viewers need of the protocol, and of TLS."""

import subprocess


def varint(message, at):
    """A protobuf number and where it ends."""
    value, shift = 0, 0
    while True:
        value |= (message[at] & 0x7F) << shift
        if message[at] < 0x80:
            return value, at + 1
        shift, at = shift + 7, at + 1


def header_numbers(message):
    """The whole numbers of a frame's FrameHeader by their fields' numbers; 0 is absent."""
    numbers, at, end = {}, 4, 4 + int.from_bytes(message[2:4], "little")
    while at < end:
        tag, at = varint(message, at)
        kind = tag & 7
        if kind == 0:
            numbers[tag >> 3], at = varint(message, at)
        elif kind == 2:
            length, at = varint(message, at)
            at += length
        else:
            at += {1: 8, 5: 4}[kind]
    return numbers


def frame_id(message):
    return header_numbers(message)[1]


def make_certificate(certificate, key, name):
    """Two days' self-signed certificate of 127.0.0.1 and its key, as PEM files."""
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
                    "-nodes", "-days", "2", "-subj", f"/CN={name}", "-addext",
                    "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", certificate],
                   check=True, capture_output=True)
