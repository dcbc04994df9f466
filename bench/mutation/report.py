# SPDX-License-Identifier: Apache-2.0
"""What a run of the mutants found: mutants.json, survivors.md and the share killed."""
import collections
import json
import math

WORDS = {"killed": "killed", "survived": "survived", "not reached": "reached by no test"}


def key(mutant):
    """A mutant of an unchanged file is the same mutant."""
    return f"{mutant['number']} {mutant['hash']}"


def load(file):
    return {key(mutant): mutant for mutant in json.loads(file.read_text())} if file.exists() else {}


def reasons(file):
    """Place -> why no test can notice its mutant, of a text with `place -- reason` a line."""
    found = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        if line and not line.startswith("#"):
            place, _, reason = line.partition(" -- ")
            found[place.strip()] = reason.strip()
    return found


def place(mutant):
    """Says which mutant it is whatever lines are added before it."""
    return f"{mutant['file']} | {mutant['source']} | {mutant['text']} | {mutant['mutant']}"


def write(folder, verdicts, equivalent):
    """Both files; returns the sentence with the share."""
    folder.mkdir(parents=True, exist_ok=True)
    verdicts = sorted(verdicts, key=lambda mutant: (mutant["file"], mutant["line"], mutant["number"]))
    (folder / "mutants.json").write_text(json.dumps(verdicts, indent=1) + "\n")
    survivors = [mutant for mutant in verdicts if mutant["verdict"] != "killed"]
    listed = [mutant for mutant in survivors if place(mutant) in equivalent]
    lines = ["# Mutants that no test noticed", ""]
    for mutant in survivors:
        run = f"{mutant['cases']} of {mutant['of']} cases run" if mutant["of"] else "reached by no test"
        reason = equivalent.get(place(mutant))
        lines.append(f"- `{mutant['file']}:{mutant['line']}` {mutant['mutant']}: `{mutant['text']}` ({run})"
                     f"{'; listed: ' + reason if reason else ''}\n  `{place(mutant)}`")
    (folder / "survivors.md").write_text("\n".join(lines) + "\n")
    return summary(verdicts, survivors, listed)


def share(killed, total):
    return f"{killed} of {total} ({100 * killed / total:.1f} %)" if total else "none"


def interval(killed, total):
    """Wilson's of 95 %, in per cent: what a sample says of all mutants. E. B. Wilson, J. Am. Stat. Assoc. 22:209 (1927)."""
    z, share_killed = 1.96, killed / total
    middle = (share_killed + z * z / (2 * total)) / (1 + z * z / total)
    half = z / (1 + z * z / total) * math.sqrt(share_killed * (1 - share_killed) / total + z * z / (4 * total * total))
    return f"{100 * (middle - half):.1f} … {100 * (middle + half):.1f} %"


def summary(verdicts, survivors, listed):
    by_folder = collections.defaultdict(lambda: [0, 0])
    for mutant in verdicts:
        entry = by_folder["/".join(mutant["file"].split("/")[:3])]
        entry[0] += mutant["verdict"] == "killed"
        entry[1] += 1
    lines = [f"  {folder:32} killed {share(*entry)}" for folder, entry in sorted(by_folder.items())]
    unreached = sum(mutant["verdict"] == "not reached" for mutant in survivors)
    lines.append(f"killed {share(len(verdicts) - len(survivors), len(verdicts))}; {len(survivors)} survived, {unreached} of "
                 f"them reached by no test, {len(listed)} listed with a reason: without those "
                 f"{share(len(verdicts) - len(survivors), len(verdicts) - len(listed))}")
    counted = len(verdicts) - len(listed)
    if counted:
        lines.append(f"95 % interval of the last share, where this is a sample: "
                     f"{interval(len(verdicts) - len(survivors), counted)}")
    return "\n".join(lines)
