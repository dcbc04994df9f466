# SPDX-License-Identifier: Apache-2.0
# The data were made with mu = 300 kPa and Jm = 20.
tunica_expect_between(297 303 runs 0 best parameters mu value)
tunica_expect_between(19.8 20.2 runs 0 best parameters Jm value)
