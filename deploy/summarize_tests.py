"""Adds up the stages of test.sh.

Usage: summarize_tests.py REPORTS [INNER], where REPORTS/stages.tsv has a line "name, exit code, seconds"
for each stage and REPORTS/NAME.xml, where there is one, is its JUnit report. INNER/NAME.xml is the report
that the test NAME itself wrote of those that it consists of; they are counted in its place. Exit 1 if
anything failed.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


def count(report, inner=None):
    """(passed, failed names, skipped names) of a JUnit report."""
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
                failed.append(name)
        elif failure:
            failed.append(name)
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
        failed = [f"{name}: exit code {exit_code}"]
    return passed, failed, skipped


def main():
    reports = Path(sys.argv[1])
    inner = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    total_passed, all_failed, all_skipped = 0, [], []
    print(f"\n{'stage':<10}{'passed':>8}{'failed':>8}{'skipped':>8}{'seconds':>9}")
    for line in (reports / "stages.tsv").read_text().splitlines():
        name, exit_code, seconds = line.split("\t")
        passed, failed, skipped = count_stage(reports, inner, name, int(exit_code))
        print(f"{name:<10}{passed:>8}{len(failed):>8}{len(skipped):>8}{seconds:>9}")
        total_passed += passed
        all_failed += failed
        all_skipped += skipped
    for name in all_skipped:
        print(f"SKIPPED {name}")
    for name in all_failed:
        print(f"FAILED {name}")
    print(f"\n{total_passed} passed, {len(all_failed)} failed")
    return 1 if all_failed else 0


if __name__ == "__main__":
    sys.exit(main())
