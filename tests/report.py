#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Prints the suites of the JUnit files that ctest has written, with their times, and one line of counts at the end."""
import collections
import sys
import xml.etree.ElementTree as xml


def suite_of(name):
    """The part of a test's name before its first colon."""
    return name.split(":")[0]


def main(files):
    suites = collections.OrderedDict()
    total = collections.Counter()
    for file in files:
        for case in xml.parse(file).getroot().iter("testcase"):
            status = case.get("status")
            kind = "passed" if status == "run" else "failed" if status == "fail" else "skipped"
            suite = suites.setdefault(suite_of(case.get("name")), collections.Counter())
            suite[kind] += 1
            suite["seconds"] += float(case.get("time"))
            total[kind] += 1
    print(f"{'suite':<24}{'passed':>8}{'failed':>8}{'skipped':>9}{'seconds':>10}")
    for name, counts in sorted(suites.items()):
        print(f"{name:<24}{counts['passed']:>8}{counts['failed']:>8}{counts['skipped']:>9}{counts['seconds']:>10.1f}")
    print(f"{total['passed']} passed, {total['failed']} failed, {total['skipped']} skipped")
    return 0 if total["passed"] > 0 and total["failed"] == 0 else 1


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("report.py: give it the JUnit files of ctest")
    sys.exit(main(sys.argv[1:]))
