#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""causes_test.py TUNICA [CAUSE...]: sheets of bench/fields/sheet.py with one cause and noise of 20 um (seeds 1 to 4). The diagnosis names
it, and finds its amplitude to a quarter, with its sign; a sheet without a cause raises no alarm, which it does with a chance
of 5 %. A fit warns where points err together, and not where each errs by itself (chance of either: below 1e-4)."""
import math
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent / "../../bench/fields"))
import causes

HIDDEN = [(None, 0.0, 0.0), ("stiffer_half", 0.04, 0.0), ("clamp_slip", 0.012, 0.0), ("oblique_pull", 0.6, 0.0)]

wanted = sys.argv[2:] or [str(cause) for cause, *_ in HIDDEN]
assert set(wanted) <= {str(cause) for cause, *_ in HIDDEN}, wanted
with tempfile.TemporaryDirectory() as scratch:
    bench = causes.Bench(pathlib.Path(sys.argv[1]), pathlib.Path(scratch), 0.02, (8, 6))
    for seed, (cause, amplitude, direction) in enumerate(HIDDEN, 1):
        if str(cause) not in wanted:
            continue
        folder = pathlib.Path(scratch) / str(cause)
        frames = bench.frames(cause, amplitude, direction)
        bench.write(folder, frames, "clamped", seed)
        found = bench.call(folder, "diagnose", "--quick")["diagnosis"]
        if cause is None:
            for subset in (0, 6):
                again = folder / str(subset)
                bench.write(again, frames, "clamped", seed, subset)
                warnings = bench.call(again, "run")["warnings"]
                assert any("err together" in one for one in warnings) == (subset > 0), (subset, warnings)
            assert found["verdict"] == "nothing_detected", found["verdict"]
            continue
        assert [one["id"] for one in found["causes"]] == [cause], (cause, found["verdict"], found["causes"])
        size = found["causes"][0]["amplitude"]["value"]
        # A cause with a direction is the same with the opposite amplitude in the opposite direction.
        turned = [one["value"] - direction for one in found["causes"][0]["nuisance"] if one["name"] == "direction"]
        size *= math.cos(math.radians(sum(turned)))
        assert 0.75 < size / amplitude < 1.25, (cause, amplitude, found["causes"])
        print(cause, amplitude, size, found["verdict"])
