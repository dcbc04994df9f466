// SPDX-License-Identifier: Apache-2.0
// Carries the precompiled header that plugins share; nothing is linked from here.
