#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the C++ examples of the pages of components as one file to compile: component_examples.py PAGES OUTPUT NAME..."""
import pathlib
import re
import sys


def main(pages, output, names):
    includes, scenes = set(), []
    for name in names:
        blocks = re.findall(r"^```cpp\n(.*?)^```", (pages / f"{name}.md").read_text(), flags=re.M | re.S)
        if len(blocks) != 1:
            sys.exit(f"{pages}/{name}.md has {len(blocks)} examples in C++, not one")
        includes.update(re.findall(r"^#include .*$", blocks[0], flags=re.M))
        scene = re.sub(r"^#include .*\n", "", blocks[0], flags=re.M).strip()
        scenes.append(f"namespace example_of_{name} {{\n{scene}\n}}  // namespace example_of_{name}\n")
    output.write_text("\n".join(sorted(includes)) + "\n#include <string>\n\n" + "\n".join(scenes))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:])
