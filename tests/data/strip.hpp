// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/dataset.hpp"
#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::testing {

using Mapping = std::vector<std::pair<std::string, std::string>>;

/// What a strip in tension declares.
inline const std::vector<Observable>& strip_observables() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  static const std::vector<Observable> observables = {
      {"stretch", "1", Role::abscissa, true, "stretch along the strip", Kind::stretch},
      {"stress", "kPa", Role::channel, false, "stress along the strip", Kind::stress},
      {"transverse_stretch", "1", Role::channel, false, "stretch across", Kind::stretch},
      {"time", "s", Role::time, false, "time since rest", Kind::plain}};
  return observables;
}

/// Reads texts as the files (replicates, if several) of a strip; by default `stretch` and `stress` are mapped to the
/// columns of those names. Messages name the first file "strip.csv".
inline data::Dataset read_strips(const std::vector<std::string>& texts, const Mapping& columns = {},
                                 data::DataRequest request = {}) {
  const Folder folder;
  for (std::size_t i = 0; i < texts.size(); ++i)
    request.files.push_back(folder.write(i == 0 ? "strip.csv" : "strip" + std::to_string(i + 1) + ".csv", texts[i]));
  request.columns = columns.empty() ? Mapping{{"stretch", "stretch"}, {"stress", "stress"}} : columns;
  const auto without_folder = [&](std::string message) {
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
    return message;
  };
  try {
    data::Dataset dataset = data::read_dataset(request, strip_observables());
    for (std::string& warning : dataset.warnings) warning = without_folder(warning);
    return dataset;
  } catch (const InputError& error) {
    throw InputError(without_folder(error.what()));
  }
}

inline data::Dataset read_strip(std::string_view text, const Mapping& columns = {},
                                const data::DataRequest& request = {}) {
  return read_strips({std::string(text)}, columns, request);
}

inline std::string strip_refusal(std::string_view text, const Mapping& columns = {},
                                 const data::DataRequest& request = {}) {
  return message_of<InputError>([&] { read_strip(text, columns, request); });
}

/// A mapping of rigs that record the way of the grip and the force, and a strip's sizes (mm); stress: first
/// Piola-Kirchhoff.
inline const Mapping by_force = {{"displacement", "Way"}, {"force", "Force"}};

inline data::DataRequest strip_of(double width, double thickness, double gauge_length) {
  data::DataRequest request;
  request.specimen.all.width = width;
  request.specimen.thickness = thickness;
  request.specimen.all.gauge_length = gauge_length;
  request.stress_measure = "first_piola_kirchhoff";
  return request;
}

}  // namespace tunica::testing
