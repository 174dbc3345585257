"""Checks the rules of CONTRIBUTING.md and ARCHITECTURE.md that a compiler cannot.

Usage: check_layers.py ROOT. Prints one line for each violation; exit 1 if there is any. Hints are
printed too, and never fail.
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from git_files import committed_files
from page_layers import PAGE, allowed_imports, check_page

# Names that are no folders of server/: shaders/interface, the embedded SPIR-V, and protocol/.
SHADER_LAYERS = {"interface", "shaders"}
LAYER = re.compile(r"\bfroxel_layer\(([^)]*)\)")
DEPENDS = re.compile(r"\bDEPENDS\b(.*?)(?:\bLIBRARIES\b|\bSOURCES\b|$)", re.S)
WINGS = re.compile(r"\bWINGS\b(.*?)(?:\bDEPENDS\b|\bLIBRARIES\b|\bSOURCES\b|$)", re.S)

# The first folder of an #include "..." where it is not the layer's own name.
LAYER_OF_FOLDER = {"froxel": "protocol"}  # generated: froxel/v1/client.pb.h
LAYER_OF_FILE = {"embedded.h": "shaders"}

# (pattern, layers that may, reason)
RESTRICTED = [
    (re.compile(r"#include <boost/beast"), {"transport", "net", "load"},
     "HTTP and WebSocket belong to transport, net and load"),
    (re.compile(r"#include <boost/asio"), {"transport", "net", "load", "app"},
     "sockets belong to transport, net and load, signals to app"),
    (re.compile(r'#include (<vulkan/|"gpu/vulkan\.h")'), {"gpu", "render"},
     "Vulkan belongs to gpu and render"),
    (re.compile(r"#include <tiny_gltf"), {"gltf"}, "scene files belong to gltf"),
    (re.compile(r"#include <(stb/|stb_)"), {"environment", "still"}, "stb belongs to environment and still"),
    (re.compile(r"#include <OpenEXR/"), {"exr", "encode"}, "OpenEXR belongs to exr and encode"),
    (re.compile(r"#include <png\.h>"), {"png"}, "libpng belongs to png"),
]
BANNED = [
    (re.compile(r"#include <iostream>"), "it adds static constructors; log or print"),
    (re.compile(r"std::endl"), "it flushes; write '\\n'"),
    (re.compile(r"\bTODO\b|\bFIXME\b"), "do it, or open an issue"),
]
BANNED_IN_TESTS = [
    (re.compile(r"\bsleep_for\b|\bsleep_until\b|\busleep\("), "wait for a condition"),
]
GENERATED = re.compile(r"(\.pb\.(h|cc)|_pb\.(ts|js)|\.spv|\.spv\.h)$|^client-web/(src/gen|dist)/")
SOURCES = {".h", ".cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
HINT_LINES = 600  # a longer file may well be two; whoever reads it judges


def dependencies(cmake):
    """What a layer may include besides itself: DEPENDS of the froxel_layer()s of its CMakeLists.txt."""
    return {word for call in LAYER.findall(cmake) for names in DEPENDS.findall(call) for word in names.split()}


def wings(cmake):
    """The folders of a layer that has some, lowest first: one may include those before it."""
    return [wing for call in LAYER.findall(cmake) for names in WINGS.findall(call) for wing in names.split()]


def of_layers(root, read):
    """What read(the text of its CMakeLists.txt) gives of every layer, by its name."""
    lists = {folder: folder / "CMakeLists.txt" for folder in [*(root / "server").iterdir(), root / "protocol"]}
    return {folder.name: read(file.read_text(encoding="utf-8")) for folder, file in lists.items() if file.exists()}


def allowed_includes(root):
    """What every layer may include besides itself, by its name."""
    return of_layers(root, dependencies)


def check_house(document, may_include, folder="(?:server/)?"):
    """Yields the rows of ARCHITECTURE.md's table of the layers under folder, a pattern, that say something else."""
    rows = re.findall(rf"^\| `{folder}([a-z0-9_]+)` \|.*\| ([^|]*) \|$", document, re.M)
    told = {layer: {name.strip() for name in names.split(",")} for layer, names in rows}
    for layer, allowed in may_include.items():
        if told.get(layer, {"no row"}) != (set(allowed) or {"nothing of ours"}):
            yield f"ARCHITECTURE.md: {layer} may include {', '.join(sorted(allowed)) or 'nothing of ours'}"


def layer_of_include(path, layers):
    """The layer that an #include "path" reaches, or None for a name that is no layer's."""
    if path in LAYER_OF_FILE:
        return LAYER_OF_FILE[path]
    folder = path.split("/")[0]
    folder = LAYER_OF_FOLDER.get(folder, folder)
    return folder if folder in layers | SHADER_LAYERS else None


def check_file(name, layer, lines, may_include):
    """Yields the violations of one file of a layer; `layer` is "tests" outside server/."""
    if name.endswith(".h") and "#pragma once" not in lines:
        yield f"{name}: no #pragma once"
    bans = BANNED + (BANNED_IN_TESTS if layer == "tests" else [])
    for number, line in enumerate(lines, 1):
        where = f"{name}:{number}"
        for pattern, reason in bans:
            if pattern.search(line):
                yield f"{where}: {pattern.pattern} is banned: {reason}"
        if layer == "tests":
            continue
        for pattern, allowed, reason in RESTRICTED:
            if layer not in allowed and pattern.search(line):
                yield f"{where}: {line.strip()} in {layer}: {reason}"
        include = INCLUDE.match(line)
        if not include:
            continue
        target = layer_of_include(include[1], set(may_include))
        if target is None:
            yield f'{where}: "{include[1]}" does not start with a layer'
        elif target != layer and target not in may_include[layer]:
            allowed = ", ".join(sorted(may_include[layer])) or "no other layer"
            yield f"{where}: {layer} may not include {target}, only {allowed} (DEPENDS of its CMakeLists.txt)"


def check_wings(layer, path, lines, order):
    """Yields the includes of a file, whose path starts below its layer, that run up between the layer's wings."""
    def wing_of(below):
        folder = below.split("/")[0]
        return order.index(folder) if folder in order else len(order)

    for number, line in enumerate(lines, 1):
        include = INCLUDE.match(line)
        if include and include[1].startswith(f"{layer}/"):
            below = include[1].removeprefix(f"{layer}/")
            if wing_of(below) > wing_of(path):
                yield f"server/{layer}/{path}:{number}: {order[wing_of(path)]} may not include {include[1]} (WINGS)"


def sources_of(folder):
    """(path, lines) of every source under a folder."""
    for path in sorted(folder.rglob("*")):
        if path.suffix in SOURCES:
            yield path, path.read_text(encoding="utf-8").splitlines()


def layer_folders(root):
    """(layer, folder) of every layer, and the tests under the name "tests"."""
    for folder in sorted((root / "server").iterdir()):
        if folder.is_dir():
            yield folder.name, folder
    yield "protocol", root / "protocol"
    yield "tests", root / "tests"


def check_tree(root):
    """Yields every violation under root."""
    may_include = allowed_includes(root)
    wings_of = of_layers(root, wings)
    for layer, folder in layer_folders(root):
        if layer not in may_include and layer != "tests":
            yield f"{folder.relative_to(root)}: no CMakeLists.txt makes it a layer"
            continue
        for path, lines in sources_of(folder):
            yield from check_file(str(path.relative_to(root)), layer, lines, may_include)
            if wings_of.get(layer):
                yield from check_wings(layer, path.relative_to(folder).as_posix(), lines, wings_of[layer])


def hints(root):
    """Yields a line for each file that may be worth cutting by purpose."""
    for _, folder in layer_folders(root):
        for path, lines in sources_of(folder):
            if len(lines) > HINT_LINES:
                yield f"hint: {path.relative_to(root)}: {len(lines)} lines; is it one matter?"


def check_committed(paths):
    """Yields the paths that are build products."""
    for path in paths:
        if GENERATED.search(path):
            yield f"{path}: generated code is built, never committed"


def check_built(paths, text_of):
    """Yields the sources that no CMakeLists.txt builds; text_of(path) is a file's text."""
    lists = {path: text_of(path) for path in paths if Path(path).name == "CMakeLists.txt"}
    for path in map(Path, paths):
        if path.suffix != ".cpp":
            continue
        near = (lists.get(str(folder / "CMakeLists.txt"), "") for folder in path.parents[:2])
        named = re.compile(rf"\b{path.stem}(\.cpp)?\b")
        if not any(map(named.search, near)) and not any(str(path) in text for text in lists.values()):
            yield f"{path}: no CMakeLists.txt names it, so it is never built"


def main():
    root = Path(sys.argv[1]).resolve()
    committed = committed_files(root)
    architecture = (root / "ARCHITECTURE.md").read_text(encoding="utf-8")
    violations = [*check_tree(root), *check_house(architecture, allowed_includes(root)), *check_page(root),
                  *check_house(architecture, allowed_imports(root), f"{PAGE}/(?:src/)?"),
                  *check_committed(committed),
                  *check_built(committed, lambda path: (root / path).read_text(encoding="utf-8"))]
    for line in [*violations, *hints(root)]:
        print(line)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
