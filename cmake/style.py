#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks of the sources that need no compiler: style.py ROOT lines|licence|comments|prose|format CLANG_FORMAT."""
import pathlib
import re
import subprocess
import sys

CODE = {".cpp", ".hpp"}
SCRIPTS = {".py", ".cmake", ".sh"}
LONGEST = 400
COMMENTS = 40  # per cent of the lines of a public header


def sources(root):
    """Tracked files; in an unpacked archive without git, all files outside build and results."""
    if (root / ".git").exists():
        listing = subprocess.run(["git", "-c", f"safe.directory={root}", "-C", str(root), "ls-files", "-z"],
                                 check=True, capture_output=True, text=True).stdout
        files = [root / name for name in listing.split("\0") if name]
    else:
        files = [path for path in root.rglob("*") if path.relative_to(root).parts[0] not in ("build", "results")]
    return sorted(path for path in files if path.is_file())


def allowed_long_files(root):
    """cmake/long_files.txt: `path: reason` a line."""
    allowed = {}
    for line in (root / "cmake/long_files.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            path, _, reason = line.partition(":")
            allowed[path.strip()] = reason.strip()
    return allowed


def check_lines(root):
    allowed = allowed_long_files(root)
    problems = [f"cmake/long_files.txt: '{path}' has no reason" for path, reason in allowed.items() if not reason]
    lengths = {str(path.relative_to(root)): len(path.read_text().splitlines())
               for path in sources(root) if path.suffix in CODE | SCRIPTS}
    for path, length in lengths.items():
        if length > LONGEST and path not in allowed:
            problems.append(f"{path}: {length} lines, expected at most {LONGEST}; split it by concept, or give a "
                            "reason in cmake/long_files.txt")
    for path in allowed:
        if lengths.get(path, 0) <= LONGEST:
            problems.append(f"cmake/long_files.txt: '{path}' is not over {LONGEST} lines; take it off the list")
    return problems


def check_licence(root):
    problems = []
    for path in sources(root):
        script = path.suffix in SCRIPTS or path.name == "CMakeLists.txt" or path.name in ("bootstrap", "run")
        if path.suffix not in CODE and not script:
            continue
        head = path.read_text().splitlines()[:3]
        if sum("SPDX-License-Identifier: Apache-2.0" in line for line in head) != 1:
            problems.append(f"{path.relative_to(root)}: expected one line 'SPDX-License-Identifier: Apache-2.0' at the top")
    return problems


def check_comments(root):
    """The contracts of the SDK: lines that are comment, of all that are not blank, without the licence."""
    problems = []
    for path in sorted((root / "core/include/tunica").glob("*.hpp")):
        lines = [line.strip() for line in path.read_text().splitlines()[1:] if line.strip()]
        share = 100 * sum(line.startswith("//") for line in lines) / len(lines)
        if share < COMMENTS:
            problems.append(f"{path.relative_to(root)}: {share:.0f} % of the lines are comment, expected at least "
                            f"{COMMENTS} %; say what an author of plugins asks: shapes, units, failure, threads, source")
    return problems


def check_format(root, clang_format):
    files = [str(path) for path in sources(root) if path.suffix in CODE]
    result = subprocess.run([clang_format, "--dry-run", "-Werror", *files], capture_output=True, text=True)
    wrong = sorted({line.split(":")[0] for line in result.stderr.splitlines() if "clang-format-violations" in line})
    if result.returncode and not wrong:
        return [result.stderr]
    return [f"{pathlib.Path(path).relative_to(root)}: not formatted; run: {clang_format} -i {path}" for path in wrong]


# A call that searches a text, or a comparison, and the literals of its arguments.
SEARCH = re.compile(r"(?:(?:\.|->)(?:find|rfind|contains|starts_with|ends_with|compare|includes|indexOf|startsWith|"
                    r"endsWith|match|search|test)\s*\(|\b(?:strstr|strn?cmp|regex_search|regex_match|RegExp)\s*\(|"
                    r"\bregex\s+\w+\s*[({])")
COMPARED = re.compile(r'[=!]=\s*"((?:\\.|[^"\\\n])*)"|"((?:\\.|[^"\\\n])*)"\s*[=!]=')
PIECE = re.compile(r'(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<raw>R"(?P<end>\w*)\(.*?\)(?P=end)")|"(?P<text>(?:\\.|[^"\\\n])*)"|'
                   r"'(?P<single>(?:\\.|[^'\\\n])*)'", re.S)
PLANTED = ['std::regex bound("AT ITS BOUND");', 'if (warning.find("AT ITS BOUND") != npos)', 'warning.starts_with(run + ": not an optimum")',
           'if (reason == "nothing succeeded")', "text.includes('two words')", 'group.find(" on ")']
HARMLESS = ['node.find("stop")', 'namespace tunica::search { "two words" }', 'text.find(\' \')', 'throw Error("two words")', '// line.find("two words")',
            'known.find(name) == known.end() ? "two words" : ""', 'name.find(" [")', 'std::find(a, b, "x")']


def is_prose(literal):
    """A word and a space: a code has no spaces, punctuation no words."""
    return " " in literal and re.search(r"[^\W\d_]{2,}", literal) is not None


def searched_sentences(code):
    """(line, literal) where code decides by words that a person reads."""
    blank = lambda found: re.sub(r"[^\n]", " ", found[0])
    code = PIECE.sub(lambda found: blank(found) if found["comment"] else found[0], code)
    scripts = PIECE.sub(lambda found: blank(found) if found["raw"] else found[0], code)
    found = [(one.start(), one[1] or one[2] or "") for one in COMPARED.finditer(scripts)]
    for call in SEARCH.finditer(code):
        depth, at = 1, call.end()
        while depth > 0 and at < len(code):
            piece = PIECE.match(code, at)
            if piece:
                found.append((at, piece["text"] or piece["single"] or piece["raw"] or ""))
                at = piece.end()
                continue
            depth += (code[at] in "({[") - (code[at] in ")}]")
            at += 1
    return [(code[:at].count("\n") + 1, literal) for at, literal in found if is_prose(literal)]


def check_prose(root):
    problems = [f"cmake/style.py: does not find the planted search {one}" for one in PLANTED if not searched_sentences(one)]
    problems += [f"cmake/style.py: takes {one} for a search" for one in HARMLESS if searched_sentences(one)]
    for path in sources(root):
        place = path.relative_to(root)
        if path.suffix in CODE | {".js"} and place.parts[0] in ("core", "apps", "plugins"):
            problems += [f'{place}:{line}: searches a text for "{literal}"; sentences may change, so decide by an '
                         "enumeration or a code" for line, literal in searched_sentences(path.read_text())]
    return problems


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    checks = {"lines": check_lines, "licence": check_licence, "comments": check_comments, "prose": check_prose}
    check = sys.argv[2]
    problems = check_format(root, sys.argv[3]) if check == "format" else checks[check](root)
    for problem in problems:
        print(problem)
    sys.exit(1 if problems else 0)


main()
