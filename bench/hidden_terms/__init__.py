# SPDX-License-Identifier: Apache-2.0
"""Who hides terms of energies, and who counts how often they are found. Nothing here links or calls tunica."""
