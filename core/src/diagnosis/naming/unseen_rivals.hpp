// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// Mechanisms that act along time as this one does, each a declared look-alike of the other, and that nobody looked for
/// because clock or order are not known. Empty for a mechanism without memory.
std::vector<std::string> unseen_rivals(const Inquiry& inquiry, const Hypotheses& hypotheses, const std::string& id);

Reason not_looked_for(const std::vector<std::string>& rivals);

/// A name with such a rival is no name: the verdict becomes `indistinguishable`, and the rivals are in the tie.
void limit_by_unseen_rivals(const Inquiry& inquiry, const Hypotheses& hypotheses, Explanation& explanation);

}  // namespace tunica::diagnosis
