#!/usr/bin/env python3
"""Puts small faults into the code, one at a time, and runs the tests that should see them.

  tests/mutants/run.py [ID...] [--list] [--keep-going]     all, or those named

Works on a copy of HEAD below build/mutants, with a build of its own: the tree it is called from is never changed. Each
row of mutants.json has `id`, `file`, `from` and `to` (text that stands once in the file, and what it becomes) and
`tests`: `session` is tests/unit/session, `render/golden` is render_golden_test, `hard` is hard_test,
`ctest NAME` is a test of CTest, `page FILE` is a file or folder of Vitest. `equivalent` says why no test can see it.

Exit codes: 0 all seen, 1 some not, 2 a row does not fit the code, or tests fail without any fault.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WORK = ROOT / "build" / "mutants"
TREE = WORK / "tree"
BUILD = TREE / "build" / "test"
LOGS = WORK / "logs"
LIMIT_S = 1200  # a fault may make a test hang


class Wrong(Exception):
    """The list or the tree is not what this needs."""


def call(command, log, cwd=TREE):
    with log.open("ab") as out:
        out.write(f"$ {' '.join(map(str, command))}\n".encode())
        out.flush()
        try:
            return subprocess.run(command, cwd=cwd, stdout=out, stderr=out, timeout=LIMIT_S, check=False).returncode
        except subprocess.TimeoutExpired:
            out.write(b"hangs\n")
            return 124


def target_of(test):
    """What ninja builds for a test; None: nothing."""
    if test.startswith("page "):
        return None
    if test.startswith("ctest "):
        return "froxel"
    folder, _, name = test.partition("/")
    if folder == "render" and name:
        return f"render_{name}_test"
    return {"hard": "hard_test", "render_unit": "render_unit_test"}.get(test, f"{test}_test")


def command_of(test):
    kind, _, rest = test.partition(" ")
    if kind == "ctest":
        return ["ctest", "--test-dir", str(BUILD), "-C", "check", "-R", f"^{rest}$", "--no-tests=error"], TREE
    if kind == "page":
        return ["npx", "vitest", "run", rest], TREE / "client-web"
    target = target_of(test)
    found = sorted(path for path in (BUILD / "tests").rglob(target) if path.is_file() and os.access(path, os.X_OK))
    if not found:
        raise Wrong(f"no {target} below {BUILD}")
    return [str(found[0]), "--gtest_brief=1"], TREE


def prepare():
    """The copy at HEAD, configured."""
    LOGS.mkdir(parents=True, exist_ok=True)
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    log = LOGS / "prepare.log"
    log.unlink(missing_ok=True)
    if not TREE.exists():
        # A clone, so that nothing here can reach the tree's own index.
        if call(["git", "clone", "-q", "--no-checkout", str(ROOT), str(TREE)], log, ROOT) != 0:
            raise Wrong(f"git clone failed: {log}")
    for command in (["git", "fetch", "-q", str(ROOT), head], ["git", "checkout", "-q", "-f", head]):
        if call(command, log) != 0:
            raise Wrong(f"{' '.join(command)} failed: {log}")
    modules = TREE / "client-web" / "node_modules"
    if not modules.exists():
        modules.symlink_to(ROOT / "client-web" / "node_modules")
    if not (TREE / ".." / "shared").exists() and (ROOT / ".." / "shared").exists():
        (TREE / ".." / "shared").symlink_to((ROOT / ".." / "shared").resolve())
    if not (BUILD / "build.ninja").exists() and call(["cmake", "--preset", "test"], log) != 0:
        raise Wrong(f"cmake failed: {log}")
    if call(["npm", "run", "-s", "generate"], log, TREE / "client-web") != 0:
        raise Wrong(f"npm run generate failed: {log}")


def build(tests, log):
    targets = sorted({target for test in tests if (target := target_of(test))})
    return not targets or call(["ninja", "-C", str(BUILD), *targets], log) == 0


def failing(tests, log):
    """The first test that fails, or None."""
    for test in tests:
        command, cwd = command_of(test)
        if call(command, log, cwd) != 0:
            return test
    return None


def check(rows):
    for row in rows:
        path = TREE / row["file"]
        count = path.read_text().count(row["from"]) if path.is_file() else 0
        if count != 1:
            raise Wrong(f"{row['id']}: `from` stands {count} times in {row['file']}; once would be right")


def try_one(row):
    """(verdict, seconds)."""
    path = TREE / row["file"]
    text = path.read_text()
    log = LOGS / f"{row['id']}.log"
    log.unlink(missing_ok=True)
    started = time.monotonic()
    path.write_text(text.replace(row["from"], row["to"]))
    try:
        if not build(row["tests"], log):
            return "does not build", time.monotonic() - started
        seen_by = failing(row["tests"], log)
    finally:
        path.write_text(text)
    return f"seen by {seen_by}" if seen_by else "NOT SEEN", time.monotonic() - started


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("ids", nargs="*", metavar="ID")
    parser.add_argument("--list", action="store_true", help="print the list and end")
    arguments = parser.parse_args()
    rows = json.loads((HERE / "mutants.json").read_text())
    if unknown := set(arguments.ids) - {row["id"] for row in rows}:
        raise Wrong(f"no mutant {', '.join(sorted(unknown))} in {HERE / 'mutants.json'}")
    rows = [row for row in rows if not arguments.ids or row["id"] in arguments.ids]
    if arguments.list:
        for row in rows:
            print(f"{row['id']:5} {row['file']}: {row.get('equivalent') or ', '.join(row['tests'])}")
        return 0
    prepare()
    check(rows)
    rows_to_try = [row for row in rows if "equivalent" not in row]
    tests = sorted({test for row in rows_to_try for test in row["tests"]})
    log = LOGS / "without.log"
    log.unlink(missing_ok=True)
    failed = failing(tests, log) if build(tests, log) else "the build"
    if failed:
        raise Wrong(f"without any fault {failed} fails: {log}")
    missed = []
    for row in rows:
        if "equivalent" in row:
            print(f"{row['id']:5} equivalent: {row['equivalent']}", flush=True)
            continue
        verdict, seconds = try_one(row)
        print(f"{row['id']:5} {verdict} ({seconds:.0f} s)", flush=True)
        if not verdict.startswith("seen"):
            missed.append(row["id"])
    print(f"{len(rows_to_try) - len(missed)} of {len(rows_to_try)} seen" + (f"; not: {' '.join(missed)}" if missed else ""))
    return 1 if missed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Wrong as error:
        print(f"run.py: {error}", file=sys.stderr)
        sys.exit(2)
