"""Compiles what reads outside formats with the headers of a later Debian, warnings as errors.

Usage: newer_headers.py BUILD RELEASE [LAYER...]

A library's newer version may have other integer types, or warn of a name that it no longer wants. RELEASE's headers are
unpacked into BUILD/headers, and the sources of the LAYERS of server/ and their unit tests (none: of all) are compiled
with them as BUILD/compile_commands.json has it, but without making anything. The compiler and the C++ library are this system's:
deploy/try_debian.sh tries all of a release. Exit code 77: the packages are not to be had here, such as without a network.
"""

import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SKIPPED = 77  # SKIP_RETURN_CODE of CMakeLists.txt
PACKAGES = """wabt libtinygltf-dev nlohmann-json3-dev libmeshoptimizer-dev libdraco-dev libglm-dev libboost1.83-dev
libspdlog-dev libfmt-dev libcli11-dev libturbojpeg0-dev libpng-dev libwebp-dev libzstd-dev libopenexr-dev libimath-dev
libstb-dev libvpx-dev libseccomp-dev libpoco-dev libtinyobjloader-dev lib3mf-dev libvulkan-dev libtomlplusplus-dev prometheus-cpp-dev""".split()
KEYRING = "/usr/share/keyrings/debian-archive-keyring.gpg"
WASM_RUNTIME = "/usr/src/wasm2c"
WASM_SCRIPT = Path(__file__).resolve().parents[2] / "server/ktx2/wasm_runtime.cmake"


def run(command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def unpack(release, folder):
    """Fills folder/root with the packages; what is wrong in a line, or None."""
    stamp = folder / "packages"
    if stamp.exists() and stamp.read_text() == " ".join(PACKAGES):
        return None
    for name in ("lists/partial", "cache/archives/partial", "root"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    mirror = run(["apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages"]).stdout.split("\n")[0]
    if not mirror:
        return "apt-get knows no archive"
    (folder / "sources.list").write_text(f"deb [signed-by={KEYRING}] {mirror} {release} main\n")
    (folder / "status").write_text("")
    places = {"State::lists": folder / "lists", "State::status": folder / "status", "Cache": folder / "cache",
              "Etc::sourcelist": folder / "sources.list", "Etc::sourceparts": "/dev/null"}
    apt = ["apt-get", "-qq", "-oAPT::Sandbox::User=root", *(f"-oDir::{key}={place}" for key, place in places.items())]
    for step in (["update", "--error-on=any"], ["download", *PACKAGES]):
        done = run([*apt, *step], cwd=folder)
        if done.returncode:
            return f"apt-get {step[0]} of {release}: {(done.stderr.strip() or '?').splitlines()[-1]}"
    for package in folder.glob("*.deb"):
        subprocess.run(["dpkg-deb", "-x", package, folder / "root"], check=True)
        package.unlink()
    stamp.write_text(" ".join(PACKAGES))
    return None


def with_headers(command, root, wasm_definition):
    """The compiler's own arguments of a command, for these headers and for no output."""
    words = shlex.split(command)
    words = words[next(i for i, word in enumerate(words) if Path(word).name in {"c++", "g++", "clang++"}):]
    arguments, i = [], 0
    while i < len(words):
        if words[i] in {"-include", "-o", "-c"}:  # precompiled headers are this system's
            i += 2
            continue
        if words[i] == "-isystem" and words[i + 1].startswith("/usr/"):
            arguments += ["-isystem", f"{root}{words[i + 1]}"]
            i += 2
            continue
        arguments.append(wasm_definition if "WASM_RT_MEMCHECK_SIGNAL_HANDLER" in words[i] else words[i])
        i += 1
    return [*arguments, "-Werror", "-isystem", f"{root}/usr/include", "-fsyntax-only"]


def wanted(entry, layers):
    made = shlex.split(entry["command"])
    made = made[made.index("-o") + 1] if "-o" in made else ""
    layer = made.removeprefix("server/") if made.startswith("server/") else made.removeprefix("tests/unit/")
    return layer != made and entry["file"].endswith(".cpp") and (not layers or layer.split("/")[0] in layers)


def main():
    build, release, layers = Path(sys.argv[1]), sys.argv[2], set(sys.argv[3:])
    folder = build / "headers" / release
    folder.mkdir(parents=True, exist_ok=True)
    if wrong := unpack(release, folder):
        print(f"SKIPPED headers of {release}: {wrong}")
        return SKIPPED
    root = folder / "root"
    asked = run(["cmake", f"-DWASM_RUNTIME={root}{WASM_RUNTIME}", "-P", WASM_SCRIPT])
    definition = f"-D{asked.stderr.strip()}"
    entries = [e for e in json.loads((build / "compile_commands.json").read_text()) if wanted(e, layers)]
    if not entries:
        print(f"no source of {', '.join(sorted(layers)) or 'server'} in {build}/compile_commands.json")
        return 1

    def compile_one(entry):
        return entry, run([*with_headers(entry["command"], root, definition), entry["file"]], cwd=entry["directory"])

    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for entry, done in pool.map(compile_one, entries):
            if done.returncode:
                failed += 1
                print(f"{entry['file']} with the headers of {release}:\n{done.stderr}")
    print(f"{len(entries) - failed} of {len(entries)} units compile with the headers of {release}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
