"""Adds up the stages of test.sh.

Usage: summarize_tests.py REPORTS, where REPORTS/stages.tsv has a line "name, exit code, seconds"
for each stage and REPORTS/NAME.xml, where there is one, is its JUnit report. Exit 1 if anything
failed.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


def count(report):
    """(passed, failed names, skipped names) of a JUnit report."""
    passed, failed, skipped = 0, [], []
    for case in ElementTree.parse(report).iter("testcase"):
        name = f"{case.get('classname', '')} {case.get('name', '')}".strip()
        if case.find("failure") is not None or case.find("error") is not None:
            failed.append(name)
        elif case.find("skipped") is not None:
            skipped.append(name)
        else:
            passed += 1
    return passed, failed, skipped


def count_stage(reports, name, exit_code):
    """A stage without a report counts as one test; one that stopped early has at least a failure."""
    report = reports / f"{name}.xml"
    passed, failed, skipped = count(report) if report.exists() else (int(exit_code == 0), [], [])
    if exit_code != 0 and not failed:
        failed = [f"{name}: exit code {exit_code}"]
    return passed, failed, skipped


def main():
    reports = Path(sys.argv[1])
    total_passed, all_failed, all_skipped = 0, [], []
    print(f"\n{'stage':<10}{'passed':>8}{'failed':>8}{'skipped':>8}{'seconds':>9}")
    for line in (reports / "stages.tsv").read_text().splitlines():
        name, exit_code, seconds = line.split("\t")
        passed, failed, skipped = count_stage(reports, name, int(exit_code))
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
