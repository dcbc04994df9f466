# SPDX-License-Identifier: Apache-2.0
# The data were made with mu = 10 kPa, k1 = 30 kPa, k2 = 1.2 and b = 2.5.
tunica_expect_between(9.5 10.5 runs 0 best parameters mu value)
tunica_expect_between(28 32 runs 0 best parameters k1 value)
tunica_expect_between(1.1 1.3 runs 0 best parameters k2 value)
tunica_expect_between(2.3 2.7 runs 0 best parameters b value)
