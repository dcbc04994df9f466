# SPDX-License-Identifier: Apache-2.0
# The data were made with a compliance of 1.5e-4 per kPa, which nothing in the experiment file tells.
tunica_expect_equal(named diagnosis verdict)
tunica_expect_equal(grip_compliance diagnosis causes 0 id)
tunica_expect_between(1.35e-4 1.65e-4 diagnosis causes 0 amplitude value)
