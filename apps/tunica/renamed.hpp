// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tunica::app {

/// A text of a worked plugin under another name: the example's name, as a whole word, and where a class begins with it:
/// "DemirayLaw", but not the author Demiray.
std::string renamed(const std::string& text, const std::string& example, const std::string& name);

}  // namespace tunica::app
