#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes strips of the sets S (stabilised) and U (not stabilised) of Canales et al. 2023 (Mathematics 11:922, Table 6)."""
import pathlib
import sys

here = pathlib.Path(__file__).parent
sys.path.append(str(here.parent))
from gho_strip import write_strips  # noqa: E402

write_strips(here, "s_", (18.668, 0.1367, 24.905, 0.2912, 46.44), 49)
write_strips(here, "u_", (10.015, 5.1799e-3, 20.315, 0.17086, 45.83), 49)
