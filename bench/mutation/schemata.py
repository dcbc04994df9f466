# SPDX-License-Identifier: Apache-2.0
"""Writes the instrumented copy of a source: all mutants side by side, each behind its number."""
import collections
import zlib

FILES, PLACES = 200_000, 10_000  # numbers: a block of 10 000 for each file, so that no file moves those of another


def first_number(name):
    """The number of the first mutant of a file. It depends on nothing but the file's name."""
    return (zlib.crc32(name.encode()) % FILES) * PLACES + 1


def numbered(name, places):
    """The places with the number of their first mutant."""
    number, found = first_number(name), []
    for place in places:
        found.append((number, place))
        number += len(place.mutants)
    if number > first_number(name) + PLACES:
        raise ValueError(f"{name}: found {number - first_number(name)} mutants, expected at most {PLACES}; split the file")
    return found


def written(place, number):
    """What stands before and behind a place, and instead of its operator."""
    if place.kind == "statement":
        return f"{{ if (!tunica_mutant::is({number})) ", " }", None
    if place.kind == "and":
        return f"(tunica_mutant::is({number}) || static_cast<bool>(", "))", None
    if place.kind == "or":
        return f"(!tunica_mutant::is({number}) && static_cast<bool>(", "))", None
    if place.kind == "condition":
        return f"tunica_mutant::condition({number}, static_cast<bool>(", "))", None
    if place.kind == "negation":
        return f"tunica_mutant::negation({number}, static_cast<bool>(", "))", ""
    if place.kind == "negative":
        return f"tunica_mutant::negative({number}, ", ")", ""
    if place.type:
        return f"tunica_mutant::{place.kind}<{place.type}>({number}, ", ")", None
    return f"tunica_mutant::{place.kind}({number}, ", ")", ", "


def instrumented(text, places):
    """The source with all its mutants; `places` as numbered() gives them."""
    openings, closings, operators = collections.defaultdict(list), collections.defaultdict(list), {}
    for number, place in places:
        before, behind, operator = written(place, number)
        openings[place.begin].append((-place.end, number, before))  # the outer one first; it has the smaller number
        closings[place.end].append((-place.begin, -number, behind))  # the inner one first
        if operator is not None:
            operators[place.operator[0]] = (place.operator[1], operator)
    out, position = [], 0
    for offset in sorted({0, len(text), *openings, *closings, *operators, *(end for end, _ in operators.values())}):
        out.append(text[position:offset])
        position = offset
        out += [behind.encode() for *_, behind in sorted(closings[offset])]
        out += [before.encode() for *_, before in sorted(openings[offset])]
        if offset in operators:
            end, operator = operators[offset]
            lines = text[offset:end].count(b"\n")  # every line keeps its number
            out.append(operator.encode() + b"\n" * lines)
            position = end
    return b"".join(out)


def around(places, name, text, offsets):
    """The innermost place around each offset of the copy, else the next one behind it: what has to be left out for the
    copy to compile."""
    where = [(moved(places, name, text, place.begin, False), moved(places, name, text, place.end, True), place)
             for place in places]
    found = []
    for offset in offsets:
        inside = [(end - begin, place) for begin, end, place in where if begin <= offset <= end]
        behind = [(begin, place) for begin, _, place in where if offset < begin < offset + 100]
        if inside or behind:
            found.append(min(inside or behind, key=lambda entry: entry[0])[1])
    return found


def moved(places, name, text, offset, behind):
    """Where an offset of the source is in the copy, before or behind all that is inserted there."""
    gained = 0
    for number, place in numbered(name, places):
        before, after, operator = written(place, number)
        for at, inserted in ((place.begin, before), (place.end, after)):
            gained += len(inserted) if at < offset or (at == offset and behind) else 0
        if operator is not None and place.operator[1] <= offset:
            begin, end = place.operator
            gained += len(operator) + text.count(b"\n", begin, end) - (end - begin)
    return offset + gained
