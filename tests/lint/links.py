#!/usr/bin/env python3
"""Every link of the Markdown pages below a folder leads to a file that is there, and to a heading of it: links.py FOLDER"""
import os
import re
import sys

root = sys.argv[1]
pages = [os.path.join(folder, name) for folder, folders, names in os.walk(root) for name in names if name.endswith(".md")
         if not os.path.relpath(folder, root).startswith(("build", "out", ".git"))]


def text_of(page):
    with open(page, encoding="utf-8") as file:
        return re.sub(r"^```.*?^```", "", file.read(), flags=re.S | re.M)


def anchors(page):
    """What a heading is called in a link: lower case, without punctuation, spaces as dashes, repetitions numbered."""
    names = {}
    for heading in re.findall(r"^#+ +(.*?) *$", text_of(page), re.M):
        heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        names[name] = names.get(name, -1) + 1
        yield name if names[name] == 0 else f"{name}-{names[name]}"


faults = 0
for page in sorted(pages):
    for link in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if not os.path.exists(target):
            print(f"{page}: {link}: there is no such file")
            faults += 1
        elif anchor and target.endswith(".md") and anchor not in anchors(target):
            print(f"{page}: {link}: {target} has no such heading")
            faults += 1
sys.exit(faults > 0)
