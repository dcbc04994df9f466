// SPDX-License-Identifier: Apache-2.0
#include "execution/warning.hpp"

namespace tunica::execution {

std::string_view code(WarningKind kind) { return text::code_of(warning_codes, kind); }

std::string Warning::text() const { return run.empty() ? sentence : run + ": " + sentence; }

Warning warning_of(const data::Finding& finding) {
  const auto kind = text::value_of(warning_codes, text::code_of(data::finding_codes, finding.kind));
  return {kind.value_or(WarningKind::set_up), finding.text};
}

}  // namespace tunica::execution
