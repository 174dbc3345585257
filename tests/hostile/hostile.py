"""What an honest viewer keeps beside hostile ones, case by case.

Usage: hostile.py FROXEL [--only NAME,...] [--seconds N] [--slack N] [--out FILE] [--list]
                  [-- OPTIONS OF froxel serve]

For each case (cases/*.py) a server is started, an honest viewer moves its camera and is measured alone, then
beside hostile viewers, which come from another address and behave as the case says. Beside any of them it
must keep 40 % of its frame rate and have no gap over 0.5 s; a case may bound more, or have another bound. A
case that fails is played up to twice more, and its line says so: the machine may be busy with other things.
NAME: a case, or a file of cases. Exit code 0: all bounds hold; 1: one does not; 2: usage.
"""

import argparse
import dataclasses
import json
import sys
from pathlib import Path

import case as cases

sys.path.insert(0, str(cases.HERE.parents[0] / "load"))
from server import split_arguments

ATTEMPTS = 3
# Few enough pixels and lights that a software device draws it fluently; unless others are asked for.
SERVE = ("--size", "320x180", "--lights", "50")
# Heading, its width, and figures: alone, then beside hostile viewers.
COLUMNS = [("frames/s", 14, "{alone_fps:.1f} {fps:.1f}"), ("kept", 6, "{kept:.0%}"),
           ("gap, s", 12, "{alone_gap_s:.2f} {gap_s:.2f}"),
           ("ping p99, ms", 15, "{alone_ping_p99_ms:.1f} {ping_p99_ms:.1f}"),
           ("step, s", 9, "{step_s:g}"), ("RSS, MB", 9, "{rss_mb:.0f}"), ("device, MB", 12, "{device_mb:.0f}")]


def told(figures):
    """One line of the table."""
    return "".join(f"{form.format(**figures) if 'kept' in figures else '-':>{width}}"
                   for _, width, form in COLUMNS)


def play(case, froxel, serve, slack, known):
    """`known`: what the honest viewer has alone, by how the server is started and its room. It is measured once, and
    anew for a case that fails."""
    place = case.serve, case.scenes, case.room
    for attempt in range(1, ATTEMPTS + 1):
        figures, wrong = cases.play(case, froxel, serve, slack, known.get(place) if attempt == 1 else None)
        known[place] = figures.pop("alone", known.get(place))
        verdict = "; ".join(wrong) or "holds"
        again = "" if attempt == 1 else f" (attempt {attempt})"
        print(f"{case.name:<22}{told(figures)}  {verdict}{again}", flush=True)
        print(f"{'':<22}  hostile viewers heard: {figures.get('heard', {})}", flush=True)
        if not wrong:
            break
    return {"case": case.name, "attempts": attempt, "holds": not wrong, "wrong": wrong, **figures}


def chosen(names):
    if not names:
        return list(cases.CASES.values())
    wanted = names.split(",")
    unknown = set(wanted) - set(cases.CASES) - {case.group for case in cases.CASES.values()}
    if unknown:
        sys.exit(f"--only '{','.join(sorted(unknown))}' must be of {', '.join(cases.CASES)}")
    return [case for case in cases.CASES.values() if case.name in wanted or case.group in wanted]


def main():
    arguments, serve = split_arguments()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("froxel")
    parser.add_argument("--only", help="cases or files of cases, comma-separated")
    parser.add_argument("--out", type=Path, help="JSON of all figures")
    parser.add_argument("--list", action="store_true", help="name the cases and end")
    parser.add_argument("--seconds", type=float, help="how long each case is measured, instead of its own time")
    parser.add_argument("--slack", type=float, default=1, help="by how many times bounds may be missed: more than 1 "
                        "for busy machines, inf for binaries that a sanitizer slows down")
    options = parser.parse_args(arguments)
    cases.load_cases()
    selected = chosen(options.only)
    if options.list:
        for case in selected:
            print(f"{case.group}.{case.name}: {(case.attack.__doc__ or '').splitlines()[0]}")
        return 0
    print(" " * 22 + "".join(f"{name:>{width}}" for name, width, _ in COLUMNS), flush=True)
    serve = cases.served_with(SERVE, serve)
    if options.seconds:
        selected = [dataclasses.replace(case, seconds=options.seconds) for case in selected]
    if not options.slack >= 1:
        parser.error(f"--slack {options.slack:g} must be at least 1")
    known = {}
    results = [play(case, options.froxel, serve, options.slack, known) for case in selected]
    if options.out:
        options.out.write_text(json.dumps(results, indent=1) + "\n")
    failed = [result["case"] for result in results if not result["holds"]]
    print(f"{len(results) - len(failed)} of {len(results)} hold" +
          (f"; not {', '.join(failed)}" if failed else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
