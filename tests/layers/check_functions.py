"""Checks that functions of C++ and GLSL are short, by what Universal Ctags says of where they begin and end.

Usage: check_functions.py ROOT CTAGS. Prints a line for each longer one; exit 1 if there is any, 77 (skipped) without
that program. The page's functions are a matter of client-web/eslint.config.js.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from git_files import committed_files

MOST_LINES = 60
SOURCES = ("*.cpp", "*.h", "*.comp", "*.frag", "*.glsl", "*.vert")
SKIPPED = 77


def functions(ctags, root, paths):
    """(path, name, first line, last line) of every function that is defined in the files."""
    result = subprocess.run(
        [ctags, "--options=NONE", "--language-force=C++", "--kinds-C++=f", "--fields=+ne", "--output-format=json",
         "-L", "-"], cwd=root, check=True, capture_output=True, text=True, input="\n".join(paths))
    for line in result.stdout.splitlines():
        tag = json.loads(line)
        if "end" in tag:
            yield tag["path"], tag["name"], tag["line"], tag["end"]


def too_long(found):
    """Yields a line for each function that has more lines than are allowed."""
    for path, name, first, last in found:
        lines = last - first + 1
        if lines > MOST_LINES:
            yield f"{path}:{first}: {name} has {lines} lines; at most {MOST_LINES} are allowed"


def main():
    root, ctags = Path(sys.argv[1]).resolve(), sys.argv[2]
    if not shutil.which(ctags):
        print("skipped: no Universal Ctags")
        return SKIPPED
    violations = list(too_long(functions(ctags, root, committed_files(root, *SOURCES))))
    for line in violations:
        print(line)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
