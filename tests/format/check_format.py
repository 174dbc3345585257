"""Checks that C++ and GLSL are as .clang-format and shaders/.clang-format say.

Usage: check_format.py ROOT CLANG_FORMAT. Prints the files that are not; exit 1 if there are any, 77 (skipped) where
clang-format is of another version, which breaks lines in other places. `git ls-files '*.cpp' | xargs clang-format -i`
mends them.
"""

import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from git_files import committed_files

VERSION = "14"  # Debian 12's
SOURCES = ("*.cpp", "*.h", "*.comp", "*.frag", "*.glsl", "*.vert")
SKIPPED = 77


def unformatted(clang_format, paths):
    """The paths whose text clang-format would change."""
    result = subprocess.run([clang_format, "--dry-run", "--Werror", *paths], capture_output=True, text=True)
    found = re.findall(r"^(\S+?):\d+:\d+: error: ", result.stderr, re.M)
    if result.returncode and not found:
        sys.exit(f"{clang_format} failed: {result.stderr}")
    return sorted(set(found))


def main():
    root, clang_format = Path(sys.argv[1]).resolve(), sys.argv[2]
    version = subprocess.run([clang_format, "--version"], check=True, capture_output=True, text=True).stdout
    if not re.search(rf"version {VERSION}\.", version):
        print(f"skipped: formatted by clang-format {VERSION}, here is {version.strip()}")
        return SKIPPED
    sources = [root / path for path in committed_files(root, *SOURCES)]
    if not sources:
        print("skipped: not a git checkout")
        return SKIPPED
    found = unformatted(clang_format, sources)
    for path in found:
        print(f"{Path(path).relative_to(root)}: not as clang-format has it")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
