# SPDX-License-Identifier: Apache-2.0
# The data were made with mu = 8 kPa, k1 = 20 kPa, k2 = 0.8, d = 0.6, psi_c = 0.5 kPa and m = 4 kPa.
tunica_expect_between(6.6 9.4 runs 0 best parameters mu value)
tunica_expect_between(17 24 runs 0 best parameters k1 value)
tunica_expect_between(0.65 0.95 runs 0 best parameters k2 value)
tunica_expect_between(0.55 0.65 runs 0 best parameters d value)
tunica_expect_between(3.4 4.6 runs 0 best parameters m value)
tunica_expect_equal(damaged/lm ranking 0 run)
