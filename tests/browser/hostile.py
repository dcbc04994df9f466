# SPDX-License-Identifier: Apache-2.0
"""A copy of a result folder whose names would act if they could."""
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
    result["warning_details"] = [{"kind": NAME, "run": None, "sentence": NAME}] + result["warning_details"]
    (target / "result.json").write_text(json.dumps(result))

    def change(_, rows):
        head = [cell.replace("stress", COLUMN) for cell in rows[0]]
        return [head] + [[cell.replace(run, NAME) for cell in row] for row in rows[1:]]
    tables(target, change)
    for file in list(target.glob("fit_*.csv")):
        file.rename(target / f"fit_<img src=x onerror=window.hacked=1>{file.name[4:]}")
    return target
