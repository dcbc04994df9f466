# SPDX-License-Identifier: Apache-2.0
"""Who writes files that say what is not so, and who judges what tunica makes of them. Nothing here links or calls tunica
but to diagnose."""
