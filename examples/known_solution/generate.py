#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the two strips of this example from known parameters: x1 of Canales et al. 2023 (Mathematics 11:922)."""
import pathlib
import sys

here = pathlib.Path(__file__).parent
sys.path.append(str(here.parent))
from gho_strip import write_strips  # noqa: E402

write_strips(here, "", (10.4, 0.27, 30.6, 3.94, 61.3), 41)
