# SPDX-License-Identifier: Apache-2.0
# The data were made with a = 12 kPa and b = 1.6; the limits are four standard errors or more.
tunica_expect_between(11.8 12.2 runs 0 best parameters a value)
tunica_expect_between(1.58 1.62 runs 0 best parameters b value)
tunica_expect_equal(tissue/lm ranking 0 run)
