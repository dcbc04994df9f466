// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "text/codes.hpp"
#include "tunica/parameter.hpp"

namespace tunica::cohort {

enum class Outcome {
  fitted,      ///< every run has a result
  no_result,   ///< some run has none, or broke its constraints
  unreadable,  ///< table, experiment or data do not fit
  failed       ///< an error of a plugin, or of tunica
};
inline constexpr text::Codes<Outcome, 4> outcome_codes{{{Outcome::fitted, "fitted"},
                                                        {Outcome::no_result, "no_result"},
                                                        {Outcome::unreadable, "unreadable"},
                                                        {Outcome::failed, "failed"}}};

/// What a shard leaves of one specimen: all that the cohort needs of it, and nothing that grows with its rows. Numbers
/// read back bit for bit.
struct Record {
  struct Parameter {
    std::string name, unit;
    Scale scale = Scale::linear;
    double value = 0, min = 0, max = 0;
    std::optional<double> lower, upper;  ///< of the 95 % interval; none where the data do not fix it
    std::string at_bound;                ///< "lower", "upper" or empty
    bool identified = false;
  };
  struct Quality {
    std::string test, channel, unit;
    bool held_out = false;
    std::optional<double> r2;
    double rmse = 0;
    double largest = 0;  ///< of the measured values, without their sign
  };
  struct Run {
    std::string label, model;
    bool has_result = false;
    std::string reason;  ///< of no result, or of a broken constraint
    double objective = 0;
    std::vector<Parameter> parameters;
    std::vector<Quality> quality;
    std::optional<bool> stable;    ///< transverse stability of strips
    std::optional<double> misfit;  ///< √(χ²/ν) against the stated noise
    std::uint64_t evaluations = 0;
  };
  struct Warning {
    std::string kind, text;
  };
  std::string id;
  std::string inputs;  ///< hash of all that decides the result: experiment, data, seed, version
  std::string data;    ///< hash of the measured curves alone
  Outcome outcome = Outcome::failed;
  std::string reason;  ///< of anything but `fitted`
  std::vector<Warning> warnings;
  std::vector<Run> runs;
  double seconds = 0;  ///< the one thing in which two records of the same inputs differ
};

std::string to_json(const Record& record);

/// None if the text is not a record: truncated, changed in any digit, or of another format.
std::optional<Record> record_of(const std::string& json);

}  // namespace tunica::cohort
