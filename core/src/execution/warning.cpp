// SPDX-License-Identifier: Apache-2.0
#include "execution/warning.hpp"

namespace tunica::execution {

std::string_view code(WarningKind kind) { return text::code_of(warning_codes, kind); }

std::string Warning::text() const { return run.empty() ? sentence : run + ": " + sentence; }

}  // namespace tunica::execution
