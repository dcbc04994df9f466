// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cohort/template.hpp"
#include "data/written_file.hpp"

/// A cohort of strips in a folder of its own, whose parts a test replaces.
namespace tunica::testing {

inline constexpr const char* cohort_text = R"({
  "format": 1,
  "experiment": "strip.json",
  "specimens": "specimens.csv",
  "bind": { "/tests/strip/data/file": "{id}.csv", "/tests/strip/width": "{width}" },
  "factors": ["treatment"]
})";

inline constexpr const char* template_text = R"({ // the first specimen stands for all
  "format": 1,
  "tests": { "strip": { "type": "uniaxial", "width": 5, "data": { "file": "a.csv", "columns": {"stretch": "stretch"} } } }
})";

inline constexpr const char* table_text = "id,treatment,width [mm]\na,control,5\nb,treated,6\nc,control,7\n";

struct CohortFiles {
  std::string cohort = cohort_text, experiment = template_text, table = table_text;
  Folder folder = {};

  [[nodiscard]] cohort::Specification read() const {
    (void)folder.write("strip.json", experiment);
    (void)folder.write("specimens.csv", table);
    return cohort::read_specification(folder.write("cohort.json", cohort));
  }
  /// The first place of `from` in the cohort file becomes `to`.
  void replace(std::string& text, const std::string& from, const std::string& to) const {
    text.replace(text.find(from), from.size(), to);
  }
};

}  // namespace tunica::testing
