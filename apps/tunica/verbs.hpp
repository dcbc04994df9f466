// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "session.hpp"

/// One function per verb: it declares the arguments, and sets `action`, which does the work and returns the exit code.
namespace tunica::app {

using Action = std::function<int()>;

/// A seed on the command line; CLI11 by itself would wrap a negative one around, and take the largest for one beyond.
inline CLI::Validator seed_number() {
  return {[](std::string& text) {
            std::uint64_t seed = 0;
            const char* end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, seed);
            if (stop == end && problem == std::errc()) return std::string();
            return "a seed is a whole number from 0 to 18446744073709551615, not '" + text + "'";
          },
          ""};
}

/// Adds a verb to the command line.
using AddVerb = void(CLI::App& app, GlobalOptions& global, Action& action);

AddVerb add_run, add_cohort, add_diagnose, add_discover, add_report, add_export, add_certify, add_import, add_check,
    add_data, add_simulate, add_stability, add_list, add_describe, add_schema, add_plugin, add_completion, add_man,
    add_serve, add_studio;

/// The verbs that a first result needs, in the order of the help.
inline constexpr std::array first_verbs{add_run,      add_diagnose,  add_report, add_certify,  add_check,
                                        add_simulate, add_stability, add_list,   add_describe, add_schema};
/// All verbs but those that need the library of HTTP.
inline constexpr std::array all_verbs{
    add_run,  add_diagnose, add_discover,  add_cohort, add_report,   add_export, add_certify, add_import,     add_check,
    add_data, add_simulate, add_stability, add_list,   add_describe, add_schema, add_plugin,  add_completion, add_man};

/// Adds the verbs of this program: `all_verbs`, or `first_verbs`.
AddVerb add_verbs;

}  // namespace tunica::app
