// SPDX-License-Identifier: Apache-2.0
// A shared library like any other, with no entry point of ours.
extern "C" __attribute__((visibility("default"))) int answer() { return 42; }
