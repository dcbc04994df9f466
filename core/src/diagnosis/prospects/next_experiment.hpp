// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// The experiment that would tell the rivals of the ambiguity set apart, or where there is one cause, that would
/// confirm it: over a library of tests that a lab can make, the one whose smallest distance between refitted rivals is
/// largest (T-optimality; A. C. Atkinson, V. V. Fedorov, Biometrika 62:57, 1975), and how often it has to be repeated;
/// where none tells them apart, the test that switches one mechanism by itself. With one cause, or none, the experiment
/// for the parameter that the data determine least as well, where there is one.
std::optional<NextExperiment> next_experiment(const Inquiry& inquiry, const Evidence& evidence,
                                              const Explanation& explanation);

}  // namespace tunica::diagnosis
