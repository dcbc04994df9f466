# SPDX-License-Identifier: Apache-2.0
"""Errors of points that a camera follows."""

import numpy as np


def errors(places, sigma, subset, noise):
    """One error for each place (n × 2, mm). Of width `subset` > 0, square subsets share what they overlap: errors correlate by
    (1 − |Δx|/w)(1 − |Δy|/w). `noise` is a random.Random."""
    own = np.array([noise.gauss(0, sigma) for _ in places])
    if subset == 0:
        return own
    apart = np.abs(np.asarray(places)[:, None] - np.asarray(places)[None]) / subset
    together = np.prod(np.clip(1 - apart, 0, None), 2) + 1e-9 * np.eye(len(own))
    return np.linalg.cholesky(together) @ own
