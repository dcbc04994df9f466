# SPDX-License-Identifier: Apache-2.0
"""Mutation of the project's own code: bench/mutants.py."""
