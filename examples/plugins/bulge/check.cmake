# SPDX-License-Identifier: Apache-2.0
# The data were made with mu = 400 kPa.
tunica_expect_between(398 402 runs 0 best parameters mu value)
