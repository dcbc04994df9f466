// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/claims.hpp"

namespace tunica::diagnosis {

/// The gain of the extension. In sample it is the decrease of |r|², beside the best gain under the null and the gain of
/// the best rejected mechanism. Out of sample it predicts blocks that are left out of the fit: each test, each type of
/// test, and the rows beyond 70 % of the range of the abscissa, from those below. A test that alone shows the effect is
/// not listed, because the others cannot predict it.
///
/// The p-value of a block is Chow's: |r|² of all rows at the fit of all, less |r|² of the others at theirs, is χ² of as
/// many degrees of freedom as the block has rows.
Gain gain_of(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim);

/// An extension as this needs it: all variables of an assembly, fitted to all rows.
struct FittedExtension {
  const assembly::Assembly& assembly;
  const std::vector<Variable>& variables;
  const Fit& fit;
  /// The variables that the rows which are fitted have to show, or the block says nothing.
  std::vector<std::size_t> needed;
};

/// The blocks of rows, predicted by an extension and by the base.
std::vector<HeldOut> held_out_blocks(const Inquiry& inquiry, const Evidence& evidence, const FittedExtension& best);

/// Predicted: the error is below 2 σ and smaller than without the extension. Not predicted: it is larger than 2 σ, or
/// clearly larger than without the extension, and the p-value says that this is no chance. Far off is no contradiction
/// where the other rows leave the parameters open: the p-value knows of that.
BlockVerdict verdict_of(double before, double after, double p_value);

}  // namespace tunica::diagnosis
