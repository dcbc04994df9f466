#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""shards_test.py TUNICA: shards run by hand, in any order, killed, repeated and at once, merge to the bytes of one run."""
import pathlib
import random
import signal
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # nothing is left beside the sources
from laboratory import Program, expect, expect_same, make_cohort, records, run_cases, small

executable = small(sys.argv[1], "ceres_lm", "es", "gho", "uniaxial")
room = tempfile.TemporaryDirectory()
folder = pathlib.Path(room.name)
make_cohort(folder, 15)
make_cohort(folder / "long", 8, realisations=8)
tunica = Program(executable, folder)
tunica("cohort", "cohort.json", "-o", "whole", "--no-reports", "--quiet")


def any_number_of_shards_in_any_order_merges_to_the_same_bytes():
    order = random.Random(11)
    for shards in (1, 2, 7):
        parts = list(range(1, shards + 1))
        order.shuffle(parts)
        for part in parts:
            tunica("cohort", "cohort.json", "-o", f"of{shards}", "--shard", f"{part}/{shards}", "--no-reports", "--quiet")
        tunica("cohort", "merge", "cohort.json", "-o", f"of{shards}")
        expect_same(folder / "whole", folder / f"of{shards}", f"{shards} shards")


def shards_that_begin_at_once_share_a_new_folder():
    for attempt in range(5):
        results = f"at_once{attempt}"
        shards = [tunica.start("cohort", "cohort.json", "-o", results, "--shard", f"{part}/7", "--no-reports", "-j", "1")
                  for part in range(1, 8)]
        for shard in shards:
            _, errors = shard.communicate()
            expect(shard.returncode == 0, f"a shard ended with {shard.returncode}: {errors}")
        tunica("cohort", "merge", "cohort.json", "-o", results)
        expect_same(folder / "whole", folder / results, "shards at once")


def two_copies_of_a_shard_at_once_do_no_harm():
    copies = [tunica.start("cohort", "cohort.json", "-o", "twice", "--shard", "1/1", "--no-reports", "-j", "1")
              for _ in range(3)]
    for copy in copies:
        _, errors = copy.communicate()
        expect(copy.returncode == 0, f"a copy ended with {copy.returncode}: {errors}")
    tunica("cohort", "merge", "cohort.json", "-o", "twice")
    expect_same(folder / "whole", folder / "twice", "copies at once")


def a_killed_shard_leaves_whole_records_and_starts_again():
    long = Program(executable, folder / "long")
    long("cohort", "cohort.json", "-o", "whole", "--no-reports", "--quiet")
    results = folder / "long/killed"
    kills, draw = 0, random.Random(7)
    for _ in range(40):
        before = len(records(results))
        shard = long.start("cohort", "cohort.json", "-o", "killed", "--no-reports", "-j", "2")
        deadline = time.monotonic() + 60
        while shard.poll() is None and len(records(results)) == before and time.monotonic() < deadline:
            time.sleep(0.001)
        time.sleep(draw.uniform(0, 0.1))
        shard.send_signal(signal.SIGKILL)
        shard.communicate()
        kills += shard.returncode == -signal.SIGKILL
        for record in records(results):
            expect(record.read_text(encoding="utf-8").endswith("}\n"), f"{record} is cut off")
        if shard.returncode == 0:
            break
    expect(kills >= 2, f"killed only {kills} times: the specimens are too quick for this test")
    said = long("cohort", "merge", "cohort.json", "-o", "killed", code=None) if len(records(results)) < 8 else ""
    expect(not said or "have no result yet" in said, said)
    long("cohort", "cohort.json", "-o", "killed", "--no-reports", "--quiet")
    expect_same(folder / "long/whole", results, "killed")


def a_damaged_record_is_told_and_made_again():
    tunica("cohort", "cohort.json", "-o", "damaged", "--no-reports", "--quiet")
    record = records(folder / "damaged")[3]
    text = record.read_text(encoding="utf-8")
    place = text.index('"value": ') + len('"value": ')
    record.write_text(text[:place] + str(9 - int(text[place])) + text[place + 1:], encoding="utf-8")
    said = tunica("cohort", "merge", "cohort.json", "-o", "damaged", code=2)
    expect("1 of 15 specimens have no result yet, or a damaged one" in said, said)
    said = tunica("cohort", "cohort.json", "-o", "damaged", "--no-reports", "--quiet")
    expect("record.json: its checksum does not fit" in " ".join(said.split()), said)
    expect_same(folder / "whole", folder / "damaged", "a damaged record")


run_cases([any_number_of_shards_in_any_order_merges_to_the_same_bytes, shards_that_begin_at_once_share_a_new_folder,
           two_copies_of_a_shard_at_once_do_no_harm, a_damaged_record_is_told_and_made_again, a_killed_shard_leaves_whole_records_and_starts_again])
