#!/usr/bin/env python3
"""Patterns that make readers stumble may become fewer, never more: words.py FOLDER [--write]
Counts them in pages (README.md, CHANGELOG.md, CONTRIBUTING.md, docs/; without tables, code and what programs write) and in comments
of C++, and compares each file with words_left.txt beside this script. Exit 1 with the places where a file has more than it may;
--write records what there is today."""
import collections
import os
import re
import subprocess
import sys

LEFT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "words_left.txt")
LONGEST_LINE, LONGEST_SENTENCE = 160, 35  # characters, words
# Comments that have to be joined with the line beside them before they make a sentence.
OPENERS = "Of|The same|Those|These|What|And|Which"
TRAILING_OPENERS = OPENERS + "|of|the same|those|these|what|and|which|in|for|by|from|with|until|its|their|as"
MEANING = {
    "start": "a page begins with a command, not with a sentence that says what it is",
    "wide": f"a line of prose above {LONGEST_LINE} characters",
    "long": f"a sentence above {LONGEST_SENTENCE} words",
    "opener": "a comment that begins in the middle of a sentence",
    "trailing": "a sentence that ends with `, too`, `besides` or `as well`",
}
TRAILING = re.compile(r"(?:, too|\bbesides|\bas well)[.;]")


def in_page(text):
    """Yields (kind, line number, text) of a Markdown page."""
    keep = lambda match: re.sub(r"[^\n]", "", match.group())  # the lines stay, so that numbers are right
    text = re.sub(r"<!-- (\w+) -->.*?<!-- end of \1 -->", keep, text, flags=re.S)
    first = next((line for line in text.split("\n") if line.strip() and not line.startswith(("#", "[", "!"))), "")
    if first.startswith(("```", "    ")):
        yield "start", 1, first
    text = re.sub(r"^```.*?^```", keep, text, flags=re.S | re.M)
    sentence, begin = [], 1
    for number, line in enumerate(text.split("\n") + [""], 1):
        prose = line.strip() and not line.lstrip().startswith("|") and not line.startswith("#")
        if prose and len(line) > LONGEST_LINE:
            yield "wide", number, line
        if prose and TRAILING.search(line):
            yield "trailing", number, line
        # A list item and a paragraph begin a sentence.
        if not prose or re.match(r"\s*(?:[-*]|\d+\.) ", line):
            if len(sentence) > LONGEST_SENTENCE:
                yield "long", begin, " ".join(sentence)
            sentence, begin = [], number
        if not prose:
            continue
        for part in re.split(r"(?<=[.!?:])\s+", re.sub(r"\]\([^)]*\)", "]", line)):
            sentence += part.split()
            if re.search(r"[.!?:]$", part):
                if len(sentence) > LONGEST_SENTENCE:
                    yield "long", begin, " ".join(sentence)
                sentence, begin = [], number


def in_source(text):
    """The same of the comments of a C++ file."""
    after_code = re.compile(r"[;,{}] +// (?:" + TRAILING_OPENERS + r")\b")
    alone = re.compile(r"^\s*///? (?:" + OPENERS + r")\b")
    in_comment = False
    for number, line in enumerate(text.split("\n"), 1):
        is_comment = line.lstrip().startswith("//")
        if after_code.search(line) or (is_comment and not in_comment and alone.search(line)):
            yield "opener", number, line.strip()
        if "//" in line and TRAILING.search(line.partition("//")[2]):
            yield "trailing", number, line.strip()
        in_comment = is_comment


def places(folder):
    names = subprocess.run(["git", "-C", folder, "ls-files", "*.md", "*.h", "*.cpp"], capture_output=True, text=True, check=True).stdout.split()
    for name in names:
        page = name.endswith(".md")
        if page and not (name.startswith("docs/") or name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")):
            continue
        path = os.path.join(folder, name)
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                for kind, number, text in (in_page if page else in_source)(file.read()):
                    yield name, kind, number, text


def main():
    folder = sys.argv[1]
    if not os.path.exists(os.path.join(folder, ".git")):
        print("words.py: not a git checkout, which lists the sources")
        sys.exit(77)
    found = collections.defaultdict(list)
    for name, kind, number, text in places(folder):
        found[name, kind].append((number, text))
    if "--write" in sys.argv:
        with open(LEFT, "w", encoding="utf-8") as file:
            for (name, kind), where in sorted(found.items()):
                file.write(f"{len(where)} {kind} {name}\n")
        return 0
    with open(LEFT, encoding="utf-8") as file:
        left = {(name, kind): int(count) for count, kind, name in (line.split() for line in file)}
    more = [(key, where) for key, where in sorted(found.items()) if len(where) > left.get(key, 0)]
    for (name, kind), where in more:
        print(f"{name}: {len(where)} times, at most {left.get((name, kind), 0)}: {MEANING[kind]}")
        for number, text in where:
            print(f"  {name}:{number}: {text[:120]}")
    totals = collections.Counter()
    for (_, kind), where in found.items():
        totals[kind] += len(where)
    print("; ".join(f"{kind} {totals[kind]}" for kind in MEANING))
    return 1 if more else 0


sys.exit(main())
