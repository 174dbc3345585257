"""What git tracks, for checkers of the tree."""

import subprocess


def committed_files(root, *patterns):
    """Paths from root, a git checkout, of files whose names match; none outside one. No pattern: all."""
    if not (root / ".git").exists():
        return []
    listing = subprocess.run(["git", "-C", root, "-c", f"safe.directory={root}", "ls-files", *patterns],
                             check=True, capture_output=True, text=True)
    return listing.stdout.splitlines()
