#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py RESULTS: free hgo fits both strips (R² >= 0.998) and is unstable; constrained, two different optimisers agree
on its optimum within 0.5 %, at more than five times the free objective; gho with the constraint is stable and within
5 % of its free objective. At h = 0.7 each of six optimisers ends feasible."""
import json
import sys

result = json.load(open(sys.argv[1] + "/result.json", encoding="utf-8"))
runs = {run["run"]: run["best"] for run in result["runs"]}


def of(model, imposed):
    return {name: best for name, best in runs.items()
            if name.startswith(model + "/") and best["stability"]["imposed"] == imposed}


free = of("hgo", None)["hgo/lm"]
for test, fit in free["per_test"].items():
    for channel in fit["channels"]:
        assert channel["r2"] >= 0.998, f"free hgo, {test}: R2 {channel['r2']}"
assert free["stable"] is False and all(not d["stable"] for d in free["stability"]["transverse"]), "free hgo is stable?"

bound = of("hgo", "h = 1")
objectives = [best["objective"] for best in bound.values()]
assert len(objectives) == 3 and max(objectives) <= 1.005 * min(objectives), f"constrained hgo: {objectives}"
for name, best in bound.items():
    assert best["status"] == "ok" and best["stable"] is True, f"{name} breaks its constraint"
ratio = min(objectives) / free["objective"]
assert ratio > 5 and all(abs(best["stability"]["ratio_to_free"] / ratio - 1) < 0.01 for best in bound.values())

gho = of("gho", None)["gho/lm"]["objective"]
for name, best in of("gho", "h = 1").items():
    assert best["stable"] is True and best["objective"] <= 1.05 * gho, f"{name}: {best['objective']} against {gho}"

strict = of("hgo", "h = 0.7")
assert len(strict) == 6, f"runs at h = 0.7: {list(strict)}"
for name, best in strict.items():
    assert best["status"] == "ok" and best["stable"] is True, f"{name} at h = 0.7: {best['status']}, {best['reason']}"
    assert best["objective"] >= (1 - 1e-6) * min(objectives), f"{name}: the narrower constraint costs less"
print(f"free hgo unstable; constrained hgo costs {ratio:.2f} times its objective, by {len(bound)} optimisers; "
      "gho is stable at no cost")
