#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Holds the pages against the tree: pages.py ROOT. Each link leads to a file, and each anchor to a heading; the programs of the guide
are those of examples/guide, but for the line of the licence; each page is in the navigation of the site; the newest version in
CHANGELOG.md is that of the headers; each component has an example, in XML and in C++."""
import pathlib
import re
import sys


def headings(text):
    """The anchors of a page, as GitHub and MkDocs make them."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    found = set()
    for heading in re.findall(r"^#+ (.*)$", text, flags=re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-"))
    return found


def check_links(root, wrong):
    for page in [*root.glob("*.md"), *root.glob("docs/**/*.md")]:
        text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
        text = re.sub(r"`[^`\n]*`", "", text)
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            to = (page.parent / file).resolve() if file else page
            place = f"{page.relative_to(root)}: the link to {target}"
            if not to.exists():
                wrong.append(f"{place} leads to no file")
            elif anchor and to.suffix == ".md" and anchor not in headings(to.read_text()):
                wrong.append(f"{place} leads to no heading of that page")


def check_programs(root, wrong):
    programs = {f: f.read_text().split("\n", 1)[1] for f in sorted(root.glob("examples/guide/*.cpp"))}
    pages = [root / "docs/getting-started.md", *root.glob("docs/guide/*.md")]
    shown = {}
    for page in pages:
        for block in re.findall(r"^```cpp\n(.*?)^```", page.read_text(), flags=re.M | re.S):
            shown[block] = page.relative_to(root)
    for file, program in programs.items():
        if program not in shown:
            wrong.append(f"{file.relative_to(root)} is on no page of the guide, or has other text there")
    for block, page in shown.items():
        if block not in programs.values():
            wrong.append(f"{page}: a program that is none of examples/guide begins with\n{block[:200]}")


def check_navigation(root, wrong):
    named = set(re.findall(r"[\w./-]+\.md", (root / "mkdocs.yml").read_text()))
    there = {str(p.relative_to(root / "docs")) for p in root.glob("docs/**/*.md")}
    there = {p for p in there if not p.startswith("components/") or p == "components/README.md"}
    for page in sorted(there - named):
        wrong.append(f"mkdocs.yml: docs/{page} is not in its navigation")
    for page in sorted(named - there):
        wrong.append(f"mkdocs.yml: there is no page docs/{page}")


def check_version(root, wrong):
    header = (root / "include/sinew/version.hpp").read_text()
    version = ".".join(re.findall(r"define SINEW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))
    released = re.findall(r"^## (\d+\.\d+\.\d+) - \d{4}-\d{2}-\d{2}$", (root / "CHANGELOG.md").read_text(), flags=re.M)
    if not released or released[0] != version:
        wrong.append(f"CHANGELOG.md: its newest version is {released[:1]}, but include/sinew/version.hpp has {version}")


def check_examples(root, wrong):
    for page in sorted(root.glob("docs/components/*.md")):
        text = page.read_text()
        name = page.stem
        if name == "README":
            continue
        for language, element in ("xml", rf"<{name}[ />]"), ("cpp", rf"\b{name}\b"):
            blocks = re.findall(rf"^```{language}\n(.*?)^```", text, flags=re.M | re.S)
            if not any(re.search(element, block) for block in blocks):
                wrong.append(f"{page.relative_to(root)}: no example in {language} has a {name}")


def main(root):
    wrong = []
    check_links(root, wrong)
    check_programs(root, wrong)
    check_navigation(root, wrong)
    check_version(root, wrong)
    check_examples(root, wrong)
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
