// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/result.hpp"
#include "experiment/experiment.hpp"

/// A mend as operations on the experiment file, for programs.
namespace tunica::diagnosis {

/// {"tests", "a/b"} → "/tests/a~1b": a JSON pointer (RFC 6901).
std::string pointer(std::initializer_list<std::string_view> parts);
/// A JSON string.
std::string json_text(std::string_view words);

/// Another measure of the stresses of a test, in each of its tables that has one. False: tables may be numbered files,
/// which the experiment file has as one object.
[[nodiscard]] bool change_stress_measure(const experiment::TestEntry& test, const std::vector<Observable>& observables,
                                         std::string_view measure, std::vector<Change>& changes);
/// Another unit for these columns of a test. False: it has several tables, whose columns may share names.
[[nodiscard]] bool change_units(const experiment::TestEntry& test, const std::vector<std::string>& columns,
                                const std::string& unit, std::vector<Change>& changes);
/// Mechanisms behind those of a test, each as JSON.
void add_mechanisms(const experiment::TestEntry& test, const std::vector<std::string>& mechanisms,
                    std::vector<Change>& changes);

}  // namespace tunica::diagnosis
