# SPDX-License-Identifier: Apache-2.0
# The data were made with mu = 15 kPa, c = 30 kPa, a_t = 2, a_z = 1 and a_tz = 0.3.
tunica_expect_between(14.5 15.5 runs 0 best parameters mu value)
tunica_expect_between(27 33 runs 0 best parameters c value)
tunica_expect_between(1.85 2.15 runs 0 best parameters a_t value)
tunica_expect_between(0.85 1.15 runs 0 best parameters a_z value)
tunica_expect_between(0.25 0.35 runs 0 best parameters a_tz value)
tunica_expect_equal(wall/lm ranking 0 run)
