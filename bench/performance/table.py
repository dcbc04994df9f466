# SPDX-License-Identifier: Apache-2.0
"""The rows of a benchmark as tables: on the terminal, and between two marks of docs/performance.md."""

BEGIN, END = "<!-- begin of the table: bench/bench.py --page -->", "<!-- end of the table -->"
GROUPS = [("point/", "Material points", "a batch of 40 points, per point"), ("strip/", "Two strips", "40 points each"),
          ("sheet/", "Biaxial sheet", "40 points, two stresses each"), ("tube/", "Long tube", "35 pressures"),
          ("fe/", "Tube by finite elements", "gho, clamped, 35 pressures, one core"),
          ("composed/", "Composed models", "a batch of 40 points, per point, beside the built-in model"),
          ("history/", "Memory", "beside the model alone"), ("optimizer/", "Optimisers", "per evaluation of a function that costs nothing"),
          ("search/", "Search through the host", "per evaluation of two strips"), ("constraint/", "Constraint", "transverse stability at 82 stretches"),
          ("journal/", "Journal", ""), ("startup/", "Start of the program", ""),
          ("study/", "Whole studies", "wall time, all threads"), ("diagnosis/", "Diagnosis", "wall time, all threads")]


def seconds(value):
    for unit, factor in (("s", 1), ("ms", 1e3), ("µs", 1e6)):
        if value * factor >= 1:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"


def floors(row):
    """Those that may be compared with the row: of its own vector level where it is held to one, else all."""
    level = row["name"].partition("@")[2]
    return [one for one in row["floors"] if not level or one["level"] in ("", level)]


def floor_words(row):
    return ", ".join(f"{seconds(one['time_s'])}{' ' + one['level'] if one['level'] else ''}" for one in floors(row))


def ratio_words(row):
    return ", ".join(f"{one['ratio']:.2f}" for one in floors(row))


def peer_words(row):
    return "; ".join(f"{one['what']} {seconds(one['time_s'])}" for one in row["peers"])


def growth_words(row):
    return f"{row['growth']['by']}^{row['growth']['exponent']:.2f}" if row["growth"] else ""


def fact_words(row):
    shown = []
    for name, value in row["facts"].items():
        if value is None:
            continue
        if name == "peak_memory_bytes":
            shown.append(f"peak {value / 2 ** 20:.0f} MiB")
        elif name == "processor_s":
            continue
        elif isinstance(value, float) and not value.is_integer():
            shown.append(f"{name.replace('_', ' ')} {value:.3g}")
        else:
            shown.append(f"{name.replace('_', ' ')} {value:.0f}")
    return ", ".join(shown)


def cells(row):
    return [row["name"], seconds(row["time_s"]), f"±{100 * row['spread']:.0f} %", floor_words(row), ratio_words(row), growth_words(row),
            peer_words(row)]


HEAD = ["row", "time", "spread", "floor", "ratio", "growth", "peer"]


def terminal(rows):
    lines = [HEAD] + [cells(row) for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(HEAD))]
    return "\n".join("  ".join(word.ljust(width) for word, width in zip(line, widths)).rstrip() for line in lines)


def markdown(document):
    parts = []
    for prefix, title, of in GROUPS:
        rows = [row for row in document["rows"] if row["name"].startswith(prefix)]
        if not rows:
            continue
        parts.append(f"### {title}\n" + (f"{of[0].upper()}{of[1:]}.\n" if of else ""))
        parts.append("| row | what | time | floor | time/floor | growth | peer | beside |\n|---|---|---|---|---|---|---|---|")
        for row in sorted(rows, key=lambda row: row["name"].partition("@")[0] if prefix != "fe/" else ""):  # levels together
            parts.append("| " + " | ".join([f"`{row['name']}`", row["what"], seconds(row["time_s"]), floor_words(row), ratio_words(row),
                                            growth_words(row), peer_words(row), fact_words(row)]) + " |")
        parts.append("")
    machine = document["machine"]
    dates = sorted(row["date"] for row in document["rows"])
    parts.insert(0, f"{machine['processor']}, {machine['cores']} cores, {machine['compiler']}; measured {dates[0]}"
                 + (f" to {dates[-1]}" if dates[-1] != dates[0] else "") + ".\n")
    return "\n".join(parts).rstrip() + "\n"


def write_page(page, document):
    text = page.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    page.write_text(before + BEGIN + "\n" + markdown(document) + END + after, encoding="utf-8")
