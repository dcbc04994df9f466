# SPDX-License-Identifier: Apache-2.0
"""Copies of result folders: one whose names would act if they could, one with very many realisations."""
import csv
import json
import shutil

NAME = "</script><script>window.hacked=1</script><img src=x onerror=window.hacked=1>\"'{{x}}${x}\u2028=1+1"
COLUMN = "stress<img src=http://example.invalid/x onerror=window.hacked=1>"


def replaced(value, old):
    if isinstance(value, str):
        return value.replace(old, NAME)
    if isinstance(value, list):
        return [replaced(entry, old) for entry in value]
    if isinstance(value, dict):
        return {replaced(key, old): replaced(entry, old) for key, entry in value.items()}
    return value


def tables(folder, change):
    for file in folder.glob("*.csv"):
        if file.name == "evaluations.csv":
            continue
        with open(file, newline="", encoding="utf-8") as source:
            rows = [row for row in csv.reader(line for line in source if not line.startswith("#"))]
        rows = change(file.name, rows)
        with open(file, "w", newline="", encoding="utf-8") as target:
            csv.writer(target, lineterminator="\n").writerows(rows)


def copy(source, target):
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(source, target, ignore=shutil.ignore_patterns("evaluations.csv", "checkpoint.json", "report.html"))
    return target


def with_hostile_names(source, target, run):
    copy(source, target)
    result = replaced(json.loads((target / "result.json").read_text()), run)
    result["name"] = NAME
    result["warnings"] = [NAME] + result["warnings"]
    (target / "result.json").write_text(json.dumps(result))

    def change(_, rows):
        head = [cell.replace("stress", COLUMN) for cell in rows[0]]
        return [head] + [[cell.replace(run, NAME) for cell in row] for row in rows[1:]]
    tables(target, change)
    for file in list(target.glob("fit_*.csv")):
        file.rename(target / f"fit_<img src=x onerror=window.hacked=1>{file.name[4:]}")
    return target


def with_many_realisations(source, target, count):
    """Every run gets `count` realisations, each with a convergence of its own; the numbers need not make sense."""
    copy(source, target)

    def change(name, rows):
        head, body = rows[0], rows[1:]
        runs = list(dict.fromkeys(row[0] for row in body)) if head[0] == "run" else []
        if name == "convergence.csv":
            body = [[run, k, n, 60 + k / 10 + 1000 / n] for run in runs for k in range(1, count + 1)
                    for n in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000)]
        elif name == "realisations.csv":
            place = head.index("objective")
            first = {row[0]: row for row in reversed(body)}
            body = [[*first[run][:1], k, *first[run][2:place], 60 + k / 10, *first[run][place + 1:]]
                    for run in runs for k in range(1, count + 1)]
        return [head] + body
    tables(target, change)
    return target
