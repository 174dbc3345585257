"""Adds up the stages of test.sh.

Usage: summarize_tests.py REPORTS [INNER], where REPORTS/stages.tsv has a line "name, exit code, seconds, aim"
for each stage and REPORTS/NAME.xml, where there is one, is its JUnit report. A stage with "-" for its exit code is
no test. The aim is the seconds that the stage may take; where all took longer than their aims together, a line says
which stage grew most, and nothing fails. INNER/NAME.xml is the report that the test NAME itself wrote of those that it
consists of; they are counted in its place. Exit 1 if anything failed.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


HEAD_LINES, TAIL_LINES, LINE_CHARACTERS = 3, 8, 300


def reason(case):
    """Why a test failed: the first lines of what its report says, and the last ones, where a log ends."""
    fault = case.find("failure")
    fault = case.find("error") if fault is None else fault
    text = fault.text or ""
    if not text.strip():  # ctest puts what the test printed beside the failure
        text = f"{fault.get('message') or ''}\n{case.findtext('system-out') or ''}"
    lines = [line[:LINE_CHARACTERS] for line in text.splitlines() if line.strip()]
    if len(lines) > HEAD_LINES + TAIL_LINES:
        lines[HEAD_LINES:-TAIL_LINES] = ["..."]
    return lines


def count(report, inner=None):
    """(passed, failed, skipped names) of a JUnit report, where failed has a name and lines that say why."""
    passed, failed, skipped = 0, [], []
    for case in ElementTree.parse(report).iter("testcase"):
        name = f"{case.get('classname', '')} {case.get('name', '')}".strip()
        own = inner / f"{case.get('name')}.xml" if inner else None
        failure = case.find("failure") is not None or case.find("error") is not None
        if own and own.exists():
            counts = count(own)
            passed += counts[0]
            failed += counts[1]
            skipped += counts[2]
            if failure and not counts[1]:  # such as by a crash after the last of them
                failed.append((name, reason(case)))
        elif failure:
            failed.append((name, reason(case)))
        elif case.find("skipped") is not None or case.get("status") == "notrun":
            skipped.append(name)
        else:
            passed += 1
    return passed, failed, skipped


def count_stage(reports, inner, name, exit_code):
    """A stage without a report counts as one test; one that stopped early has at least a failure."""
    report = reports / f"{name}.xml"
    passed, failed, skipped = count(report, inner) if report.exists() else (int(exit_code == 0), [], [])
    if exit_code != 0 and not failed:
        failed = [(f"{name}: exit code {exit_code}", [])]
    return passed, failed, skipped


def times(report, inner=None):
    """(seconds, name) of each test of a JUnit report, and of those that it consists of in its place."""
    for case in ElementTree.parse(report).iter("testcase"):
        own = inner / f"{case.get('name')}.xml" if inner else None
        if own and own.exists():
            yield from times(own)
        else:
            yield float(case.get("time") or 0), f"{case.get('classname', '')} {case.get('name', '')}".strip()


def tell_times(stages, reports, inner):
    """Prints what took longest, and which stage grew where all took longer than they may."""
    dearest = sorted((row for name, *_ in stages if (reports / f"{name}.xml").exists()
                      for row in times(reports / f"{name}.xml", inner)), reverse=True)[:10]
    print("\nthe ten dearest tests, seconds:")
    for seconds, name in dearest:
        print(f"{seconds:>8.1f}  {name}")
    whole, may = sum(stage[2] for stage in stages), sum(stage[3] for stage in stages)
    print(f"\nall took {whole} s; on two cores {may} s are meant")
    if whole > may:
        name, _, seconds, aim = max(stages, key=lambda stage: stage[2] - stage[3])
        print(f"SLOW: {name} grew most, to {seconds} s where {aim} s are meant")


def main():
    reports = Path(sys.argv[1])
    inner = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    total_passed, all_failed, all_skipped = 0, [], []
    stages = []
    for line in (reports / "stages.tsv").read_text().splitlines():
        name, exit_code, seconds, aim = line.split("\t")
        stages.append((name, exit_code, int(seconds), int(aim)))
    print(f"\n{'stage':<10}{'passed':>8}{'failed':>8}{'skipped':>8}{'seconds':>9}{'aim':>6}")
    for name, exit_code, seconds, aim in stages:
        counts = ("", "", "")
        if exit_code != "-":
            passed, failed, skipped = count_stage(reports, inner, name, int(exit_code))
            counts = passed, len(failed), len(skipped)
            total_passed += passed
            all_failed += failed
            all_skipped += skipped
        print(f"{name:<10}{counts[0]:>8}{counts[1]:>8}{counts[2]:>8}{seconds:>9}{aim:>6}")
    tell_times(stages, reports, inner)
    for name in all_skipped:
        print(f"SKIPPED {name}")
    for name, why in all_failed:
        print(f"FAILED {name}", *why, sep="\n    ")
    print(f"\n{total_passed} passed, {len(all_failed)} failed")
    return 1 if all_failed else 0


if __name__ == "__main__":
    sys.exit(main())
