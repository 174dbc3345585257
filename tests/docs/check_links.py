"""Checks the documents: links, pictures, and that the index names every page.

Usage: check_links.py ROOT. Prints one line for each violation; exit 1 if there is any.
"""

import os
import re
import sys
from pathlib import Path
from urllib.parse import unquote

INDEX = "docs/README.md"
NOT_OURS = {"build", "dist", "node_modules"}  # and hidden folders
# Files whose comments name documents by their path from the root.
SOURCES = {".h", ".cpp", ".py", ".ts", ".sh", ".txt", ".glsl", ".proto", ".yaml", ".toml"}

FENCE = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
CODE = re.compile(r"`[^`]*`")
LINK = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.*)$", re.M)
ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]*:", re.I)
NAMED = re.compile(r"\bdocs/[\w./-]+\.md\b|\b(?:ARCHITECTURE|CONTRIBUTING)\.md\b")


def without_code(text):
    """The text with code blocks and code spans blanked, lines kept; a link's own text may be code."""
    text = FENCE.sub(lambda block: "\n" * block[0].count("\n"), text)
    return CODE.sub("code", text)


def anchors(text):
    """The fragments that a page's headings have on GitHub."""
    found = {}
    for title in HEADING.findall(FENCE.sub("", text)):
        title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title)
        slug = re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
        count = found.get(slug, -1) + 1
        found[slug] = count
        if count:
            found[f"{slug}-{count}"] = 0
    return set(found)


def links(text):
    """(line, target) of each link and picture."""
    plain = without_code(text)
    return [(plain.count("\n", 0, link.start()) + 1, link[1]) for link in LINK.finditer(plain)]


def check_page(root, name):
    """Yields the violations of one document."""
    path = root / name
    text = path.read_text(encoding="utf-8")
    for line, target in links(text):
        if ELSEWHERE.match(target):
            continue
        file, _, fragment = target.partition("#")
        linked = (path.parent / unquote(file)).resolve() if file else path
        if not linked.exists() or not linked.is_relative_to(root):
            yield f"{name}:{line}: {target} is not there"
        elif fragment and fragment not in anchors(linked.read_text(encoding="utf-8")):
            yield f"{name}:{line}: {target}: no heading of that name"


def check_index(root, pages):
    """Yields the pages of docs/ that its index does not link."""
    targets = {target.partition("#")[0] for _, target in links((root / INDEX).read_text("utf-8"))}
    for name in pages:
        if name.startswith("docs/") and name != INDEX and name[len("docs/"):] not in targets:
            yield f"{name}: {INDEX} does not link it"


def check_named(root, name):
    """Yields the documents that a source file names and that are not there."""
    text = (root / name).read_text(encoding="utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), 1):
        for document in NAMED.findall(line):
            if not (root / document).exists():
                yield f"{name}:{number}: {document} is not there"


def files(root):
    """Every file of ours, as its path from root."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in NOT_OURS and name[0] != ".")
        yield from (str((Path(folder) / name).relative_to(root)) for name in sorted(names))


def check_tree(root):
    """Yields every violation under root."""
    every = list(files(root))
    pages = [name for name in every if name.endswith(".md")]
    for name in pages:
        yield from check_page(root, name)
    if INDEX in pages:
        yield from check_index(root, pages)
    for name in every:
        if Path(name).suffix in SOURCES and not name.startswith("tests/docs/"):
            yield from check_named(root, name)


def main():
    violations = list(check_tree(Path(sys.argv[1]).resolve()))
    for violation in violations:
        print(violation)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
