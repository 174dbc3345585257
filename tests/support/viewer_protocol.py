"""What tests' viewers need of the protocol, and of TLS."""

import subprocess


def frame_id(message):
    """The first field of the FrameHeader, a varint."""
    value, shift, at = 0, 0, 5
    while True:
        value |= (message[at] & 0x7F) << shift
        if message[at] < 0x80:
            return value
        shift, at = shift + 7, at + 1


def make_certificate(certificate, key, name):
    """Two days' self-signed certificate of 127.0.0.1 and its key, as PEM files."""
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
                    "-nodes", "-days", "2", "-subj", f"/CN={name}", "-addext",
                    "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", certificate],
                   check=True, capture_output=True)
