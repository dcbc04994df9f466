# SPDX-License-Identifier: Apache-2.0
"""The texts that C++ sources say in errors, failed statuses and warnings: `InputError(fmt::format("…", …))` and the
like, also through a local function `refuse` or `fail` that wraps them. No compiler:
tokens, brackets and string literals."""
import re

GAP = "⟨…⟩"
NAMES = "⟨the nearest name, then all there are⟩"
SINKS = {"InputError", "PlacedError", "Refused", "PluginRefused", "LoadError", "PluginFailure", "HostFault", "invalid_argument",
         "MemoryFault", "NotApplicable", "NothingSuits",
         "runtime_error", "failed", "infeasible", "push_back", "say_error", "say_warning", "fail", "refuse", "warn",
         "Warning"}
TOKEN = re.compile(r'R"\((?P<raw>.*?)\)"|"(?P<text>(?:\\.|[^"\\])*)"|\'(?:\\.|[^\'\\])+\'|//[^\n]*|/\*.*?\*/|'
                   r"\d[\w']*|\w+|::|->|\S", re.S)
ESCAPES = {"n": " ", "t": " ", '"': '"', "\\": "\\", "'": "'"}


class Text(str):
    """The content of a string literal, apart from code."""


def tokens(source):
    for found in TOKEN.finditer(source):
        word = found[0]
        if word.startswith(("//", "/*")):
            continue
        if found["raw"] is not None or found["text"] is not None:
            raw = found["raw"]
            yield Text(raw if raw is not None else re.sub(r"\\(.)", lambda e: ESCAPES.get(e[1], e[0]), found["text"]))
        else:
            yield word


def inside(words, at):
    """What stands between the bracket words[at] and its partner, and the place behind that. Without a partner, as in a
    lambda cut at its first semicolon, what is left."""
    depth, end = 0, at
    while True:
        if end == len(words):
            return words[at + 1:], end + 1
        if not isinstance(words[end], Text):
            depth += (words[end] in "([{") - (words[end] in ")]}")
        end += 1
        if depth == 0:
            return words[at + 1:end - 1], end


def split(words, separator):
    parts, part, depth = [], [], 0
    for word in words:
        code = not isinstance(word, Text)
        depth += (word in ("(", "[", "{")) - (word in (")", "]", "}")) if code else 0
        if code and depth == 0 and word == separator:
            parts.append(part)
            part = []
        else:
            part.append(word)
    return [*parts, part] if part or parts else []


def is_text(word):
    return isinstance(word, Text)


def said(words, known):
    """The texts an expression can have, one for each branch of `? :`; GAP for what is known at run time only."""
    if "?" in [w for w in words if not is_text(w)]:
        branches = split(words, "?")
        if len(branches) > 1:
            rest = [w for part in branches[1:] for w in [*part, "?"]][:-1]
            return [text for branch in split(rest, ":") for text in said(branch, known)]
    pieces = split(words, "+")
    if len(pieces) > 1:
        return combine([said(piece, known) for piece in pieces])
    while len(words) > 2 and words[1] == "::":
        words = words[2:]
    if words and all(map(is_text, words)):
        return ["".join(words)]
    if len(words) == 1 and words[0] in known:
        return known[words[0]]
    if words and words[0] == "suggestion":
        return [NAMES]
    call = len(words) > 3 and words[1] == "(" and inside(words, 1)[1] == len(words)
    if call and words[0] in ("format", "string", "move"):
        arguments = split(inside(words, 1)[0], ",")
        return formatted(arguments, known) if words[0] == "format" else said(arguments[0], known)
    return [GAP]


def combine(alternatives):
    texts = [""]
    for one in alternatives:
        texts = [before + after for before in texts for after in one]
    return texts


def either(texts):
    """Short alternatives stand in the message side by side; others would multiply it."""
    if len(texts) == 1:
        return texts[0]
    return GAP if any(GAP in text or not text or len(text) > 40 for text in texts) else f"⟨{'/'.join(texts)}⟩"


def formatted(arguments, known):
    values = [either(said(argument, known)) for argument in arguments[1:]]
    found = []
    for template in said(arguments[0], known):
        counter = iter(range(99))

        def filled(field):
            if field[0] in ("{{", "}}"):
                return field[0][0]
            index = int(field[1]) if field[1] else next(counter)
            return values[index] if index < len(values) else GAP
        found.append(re.sub(r"{{|}}|{(\d*)(?::[^{}]*(?:{\d*}[^{}]*)*)?}", filled, template))
    return found


def wrappers(words):
    """Local functions `refuse` and `fail` that pass their text on: parameters, what they call, with what, where."""
    found = {}
    for at, word in enumerate(words):
        if word not in ("refuse", "fail") or is_text(word):
            continue
        start = at + 1
        if words[start] == "=" and words[start + 1] == "[":
            start = inside(words, start + 1)[1]
        if words[start] != "(":
            continue
        parameters, behind = inside(words, start)
        opening = next((k for k in range(behind, min(behind + 6, len(words))) if words[k] == "{"), None)
        if opening is None or ";" in words[behind:opening] or not parameters or is_text(parameters[0]):
            continue
        body = inside(words, opening)[0]
        for k, name in enumerate(body):
            names = [split(one, "=")[0][-1] for one in split(parameters, ",")]
            if name in SINKS and not is_text(name) and body[k + 1] == "(" and "help" not in names:
                found[word] = (names, name, split(inside(body, k + 1)[0], ","), range(opening, opening + len(body)))
                break
    return found


def joined(parts):
    """What is wrong and the help, as Node::fail prints them."""
    return [f"{what}. {rest}" for what in parts[0] for rest in parts[1]] if len(parts) > 1 else parts[0]


def messages(source, returns=False):
    """The messages of a source file in their order; `returns`: what functions return as text is one as well."""
    words = list(tokens(source))
    known = {words[k - 1]: ["".join(words[k + 1:words.index(";", k)])] for k in range(1, len(words) - 1)
             if words[k] == "=" and is_text(words[k + 1]) and ";" in words[k:k + 9] and
             all(map(is_text, words[k + 1:words.index(";", k)]))}
    wrapped = wrappers(words)
    for at, word in enumerate(words[:-1]):
        if is_text(word):
            continue
        if returns and word == "return" and any(map(is_text, words[at:words.index(";", at)])):
            yield from said(words[at + 1:words.index(";", at)], known)
        if word not in SINKS or words[at + 1] != ("{" if word == "Warning" else "(") or is_text(words[at + 1]):
            continue
        if word == "warn" and words[at - 1] in (".", "->"):  # of a log
            continue
        if word == "push_back" and words[at - 2] != "warnings" or any(at in one[3] for one in wrapped.values()):
            continue
        arguments = split(inside(words, at + 1)[0], ",")
        if word in wrapped and words[at - 1] not in (".", "->"):
            names, sink, passed, _ = wrapped[word]
            given = {name: said(one, known) for name, one in zip(names, arguments)}
            yield from said_by(sink, passed, {**known, **given})
        else:
            yield from said_by(word, arguments, known)


def said_by(sink, arguments, known):
    """fail() takes perhaps a place, then what is wrong, then perhaps the help; a Warning its kind before the text; the
    others take one text."""
    if sink == "push_back" and arguments and arguments[0][:1] == ["{"]:
        arguments = split(inside(arguments[0], 0)[0], ",")
        return said(arguments[1], known) if len(arguments) > 1 else []
    if sink in ("warn", "Warning"):
        return said(arguments[1], known) if len(arguments) > 1 else []
    if sink != "fail":
        return said(arguments[0], known) if arguments else []
    while len(arguments) > 1 and said(arguments[0], known) == [GAP]:
        arguments = arguments[1:]
    return joined([said(one, known) for one in arguments[:2]]) if arguments else []
