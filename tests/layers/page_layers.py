"""Checks which way the page's imports run: "layers" of client-web/package.json says it."""

import json
import os
import re
from pathlib import Path

PAGE = "client-web"
# What TypeScript names by a relative path: a module, or a worker's file.
IMPORT = re.compile(r'''(?:\bfrom|\bimport\(?|\bnew URL\()\s*['"](\.[^'"]*)['"]''')


def allowed_imports(root):
    """What a layer of the page may import besides itself, by its name."""
    return json.loads((root / PAGE / "package.json").read_text(encoding="utf-8"))["layers"]


def layer_of(path):
    """The layer of a path from client-web; None for files that put the layers together."""
    first, *rest = Path(path).parts
    if first != "src":
        return first
    if len(rest) == 1:
        return None
    return "protocol" if rest[0] == "gen" else rest[0]


def check_order(may_import):
    """Yields what a layer names that does not stand before it: where there is none, there is no circle."""
    before = set()
    for layer, allowed in may_import.items():
        for name in allowed:
            if name not in before:
                yield f"{PAGE}/package.json: {layer} may import {name}, which does not stand before it"
        before.add(layer)


def check_module(path, lines, may_import):
    """Yields the imports of one file that reach where they may not; `path` starts from client-web."""
    layer = layer_of(path)
    if layer is None:
        return
    if layer not in may_import:
        yield f"{PAGE}/{path}: {layer} is no layer of {PAGE}/package.json"
        return
    for number, line in enumerate(lines, 1):
        for module in IMPORT.findall(line):
            target = layer_of(os.path.normpath(Path(path).parent / module))
            if target != layer and target not in may_import[layer]:
                allowed = ", ".join(may_import[layer]) or "nothing of ours"
                yield f"{PAGE}/{path}:{number}: {layer} may import {allowed}, not {module} (layers of package.json)"


def check_circles(imports):
    """Yields each module that can come to itself by imports, which are {module: modules}."""
    def reached_from(start):
        found, waiting = set(), [start]
        while waiting:
            for module in imports.get(waiting.pop(), ()):
                if module not in found:
                    found.add(module)
                    waiting.append(module)
        return found

    circles = {frozenset(other for other in reached_from(module) if module in reached_from(other))
               for module in sorted(imports) if module in reached_from(module)}
    for circle in sorted(map(sorted, circles)):
        yield f"{PAGE}: {', '.join(circle)} import one another"


def check_page(root):
    """Yields every violation of the page and of its report."""
    may_import = allowed_imports(root)
    yield from check_order(may_import)
    page = root / PAGE
    imports = {}
    for path in sorted([*(page / "src").rglob("*.ts"), *(page / "report").rglob("*.ts")]):
        name = path.relative_to(page).as_posix()
        if not name.startswith("src/gen/"):
            text = path.read_text(encoding="utf-8")
            yield from check_module(name, text.splitlines(), may_import)
            imports[name] = {os.path.normpath(Path(name).parent / module) + ".ts" for module in IMPORT.findall(text)}
    yield from check_circles(imports)
