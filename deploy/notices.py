#!/usr/bin/env python3
"""Prints what Froxel is built from that others wrote, with licences.

Usage: notices.py BINARY [--texts]. The table is THIRD_PARTY.md of this repository; with --texts the licences'
whole texts follow, as in the image. It asks Debian's packages (dpkg, /usr/share/doc/*/copyright) and npm's
(client-web/package-lock.json, node_modules), so both must be installed: run deploy/build.sh first.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "client-web"
# In build_packages of common.sh, and no part of what comes out.
TOOLS = {"build-essential", "cmake", "ninja-build", "pkg-config", "glslang-tools", "spirv-tools", "protobuf-compiler",
         "python3", "ca-certificates", "nodejs", "npm"}
# What the binary has from npm, compiled from WebAssembly.
IN_BINARY = {"three": "Apache-2.0 (its copy of Basis Universal's transcoder)"}


HEAD = """# Third-party software

Froxel is built from these packages of Debian and npm. `deploy/notices.py` generates the list. The image has it with the
texts of the licences, in `/usr/local/share/doc/froxel/THIRD_PARTY.md`. The texts of what is loaded at run time are in
`/usr/share/doc`.
"""


def common(expression):
    """Lines that a shell prints with common.sh."""
    script = f'source "{ROOT}/deploy/common.sh"; {expression}'
    return subprocess.run(["bash", "-c", script], check=True, capture_output=True, text=True).stdout.split()


def sources_of(names, may_lack):
    """{source package: one of its installed packages} of the packages by these names, which others may provide."""
    listed = subprocess.run(["dpkg-query", "--show", "--showformat", "${source:Package} ${Package}, ${Provides}\n"],
                            check=True, capture_output=True, text=True).stdout
    found, missing = {}, set(names)
    for line in listed.splitlines():
        source, *provided = re.split("[ ,]+", line)
        if not names.isdisjoint(provided):
            found[source] = provided[0]
            missing -= set(provided)
    if missing and not may_lack:
        sys.exit(f"notices.py: {', '.join(sorted(missing))} not installed; run deploy/build.sh first")
    return found


def licence_of(text):
    """Of a copyright file in Debian's machine-readable format: the licence of `Files: *`, else of all files."""
    stanzas = [dict(re.findall(r"^(\S+):\s*(\S.*)$", stanza, re.M)) for stanza in text.split("\n\n")]
    whole = [entry["License"] for entry in stanzas if entry.get("Files", "").startswith("*") and "License" in entry]
    named = whole or sorted({entry["License"] for entry in stanzas if entry.get("License")})
    return ", ".join(dict.fromkeys(named)) or "see the text"


def page_packages():
    """(name, licence, folder) of npm's packages that the page or the binary may hold."""
    lock = json.loads((PAGE / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    for place, entry in sorted(lock.items()):
        name = place.rpartition("node_modules/")[2]
        if place and (not entry.get("dev") or name in IN_BINARY):
            yield name, IN_BINARY.get(name) or entry.get("license", "see the text"), PAGE / place


def debian_rows(names, use, may_lack=False):
    for source, package in sorted(sources_of(set(names), may_lack).items()):
        path = Path("/usr/share/doc") / package / "copyright"
        if not path.is_file():
            sys.exit(f"notices.py: {path} is missing; reinstall {package}")
        text = path.read_text(encoding="utf-8", errors="replace")
        yield source, licence_of(text), use, text


def rows(binary, in_image):
    """(name, licence, use, text) of each package; Debian's by their sources, whose names hardly change.

    What is loaded at run time is not there where an image is built; it brings its own texts into the image.
    """
    built = [name for name in common('names_here "${build_packages[@]}"') if name not in TOOLS]
    yield from debian_rows(built + common(f'linked_packages "{binary}"'), "binary")
    lines = (ROOT / "deploy/runtime_packages.txt").read_text(encoding="utf-8").splitlines()
    loaded = {line.split("#")[0].strip() for line in lines}
    yield from debian_rows(loaded - {"", "ca-certificates"}, "loaded at run time", may_lack=in_image)
    for name, licence, folder in page_packages():
        texts = sorted(path for path in folder.glob("*") if re.match(r"(?i)(licen[cs]e|copying)", path.name))
        text = "\n".join(path.read_text(encoding="utf-8", errors="replace") for path in texts)
        yield name, licence, "binary" if name in IN_BINARY else "page", text or licence


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--texts"]):
        sys.exit("usage: notices.py BINARY [--texts]")
    found = list(rows(Path(sys.argv[1]).resolve(), in_image=bool(sys.argv[2:])))
    print(HEAD)
    print("| package | licence | use |\n|---|---|---|")
    for name, licence, use, _ in found:
        print(f"| `{name}` | {licence} | {use} |")
    if sys.argv[2:]:
        for name, _, _, text in found:
            print(f"\n## {name}\n\n{text.strip()}")


if __name__ == "__main__":
    main()
