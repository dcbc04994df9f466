#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sentences.py SOURCE: counts the words of every sentence in README.md, CONTRIBUTING.md and docs/*.md.

Prints each page's number of sentences, their mean length and the longest one, then every sentence of more than 30 words.
Fails where README has a sentence of more than 30 words or a mean above 18, or where a page, or all pages of docs
together, have a mean above 20. Headings, tables, code blocks, figures and lists of literature are no sentences. A list
item is one of its own, and so is what stands before a list. A piece of inline code and a link count as their text shows."""
import pathlib
import re
import sys

LONGEST, README_MEAN, PAGE_MEAN = 30, 18, 20
# A full stop after one of these ends no sentence.
ABBREVIATIONS = {"al.", "fig.", "e.g.", "i.e.", "vs.", "cf.", "no.", "eq.", "sect.", "proc.", "soc.", "lond.", "trans.",
                 "biomech.", "eng.", "comput.", "methods", "appl.", "mech.", "rep."}


def blocks(text):
    """Paragraphs and list items of a page, each as one line of text."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^( *)(```|~~~).*?^ *\2 *$", "", text, flags=re.S | re.M)
    found, current, literature, in_list = [], [], False, False

    def close():
        if current:
            found.append(" ".join(current))
            current.clear()

    for line in text.splitlines():
        heading = re.match(r"#+ +(.*)", line)
        if heading:
            close()
            literature, in_list = heading[1].strip().lower() == "literature", False
            continue
        item = re.match(r" *(?:[-*+]|\d+\.) +(.*)", line)
        indented = line.startswith("    ") and not in_list
        if not line.strip() or line.lstrip().startswith("|") or indented:
            close()
            in_list = in_list and not line.lstrip().startswith("|") and (not line.strip() or line.startswith(" "))
        elif literature:
            continue
        elif item:
            close()
            in_list = True
            current.append(item[1])
        else:
            in_list = in_list and (bool(current) or line.startswith(" "))
            current.append(line.strip())
    close()
    return found


def plain(block):
    """What a reader sees of a block: no figures, the text of links, one word for a piece of code."""
    block = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", block)
    block = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", block)
    block = re.sub(r"`[^`]*`", "code", block)
    return re.sub(r"\*\*|__", "", block)


def sentences(text):
    """Lists of words. Fewer than three words are a label, not a sentence."""
    for block in blocks(text):
        words = []
        tokens = plain(block).split()
        for place, token in enumerate(tokens):
            if re.search(r"\w", token):
                words.append(token)
            bare = token.strip("()[]*_\"'“”‘’")
            ends = re.search(r"[.!?…]$", token.rstrip(")*_\"'”’"))
            initial = re.fullmatch(r"(?:[A-Z]\.)+(?:-?[A-Z]\.)*", bare)
            following = tokens[place + 1] if place + 1 < len(tokens) else ""
            starts = not following or re.match(r"[(\"'“‘*_]*[A-Z0-9|Λα-ω]", following) or following == "code" or following.startswith("tunica")
            if ends and starts and not initial and bare.lower() not in ABBREVIATIONS:
                if len(words) > 2:
                    yield words
                words = []
        if len(words) > 2:
            yield words


def main(source):
    pages = [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").glob("*.md"))]
    problems, long, total, number = [], [], 0, 0
    print(f"{'page':<28}{'sentences':>10}{'mean':>7}{'longest':>9}")
    for page in pages:
        name = str(page.relative_to(source))
        found = list(sentences(page.read_text(encoding="utf-8")))
        if not found:
            sys.exit(f"{name}: found no sentence, expected some; see blocks() in {sys.argv[0]}")
        words = sum(map(len, found))
        mean, most = words / len(found), max(found, key=len)
        print(f"{name:<28}{len(found):>10}{mean:>7.1f}{len(most):>9}  {' '.join(most[:8])} …")
        long += [(len(one), name, " ".join(one)) for one in found if len(one) > LONGEST]
        limit = README_MEAN if name == "README.md" else PAGE_MEAN
        if mean > limit:
            problems.append(f"{name}: {mean:.1f} words a sentence on average, at most {limit} are allowed")
        if name == "README.md" and len(most) > LONGEST:
            problems.append(f"{name}: a sentence of {len(most)} words, at most {LONGEST} are allowed: {' '.join(most)}")
        if name.startswith("docs"):
            total, number = total + words, number + len(found)
    print(f"{'docs/*.md':<28}{number:>10}{total / number:>7.1f}")
    if total / number > PAGE_MEAN:
        problems.append(f"docs/*.md: {total / number:.1f} words a sentence on average, at most {PAGE_MEAN} are allowed")
    for words, name, sentence in sorted(long, reverse=True):
        print(f"  {words} words, {name}: {sentence}")
    if problems:
        sys.exit("\n".join(problems) + "\nSplit the sentences listed above: one thought each.")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
