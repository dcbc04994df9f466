// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/file/correction.hpp"

namespace tunica::diagnosis {

/// The base model, fitted to the data as a correction reads them.
struct CorrectedFit {
  const Correction* correction = nullptr;
  std::shared_ptr<const assembly::Assembly> assembly;
  Fit fit;
  double log_weight = 0;  ///< ln of prior times likelihood by BIC, up to what all fits of these data share
  std::vector<Amplitude> amplitudes = {};  ///< of a correction that has any
};

/// The corrections that improve on the base fit, likeliest first. Each starts from the base optimum and from the
/// initial values, the likeliest also from random points. Ladders are climbed from the least factor, and only as long
/// as |r|² falls.
std::vector<CorrectedFit> corrected_fits(const Inquiry& inquiry, const Analysis& analysis, const Record& record,
                                         const Corrections& corrections);

/// Whether the base model leaves only noise if the data are read with this correction.
bool leaves_noise(const Inquiry& inquiry, const Analysis& analysis, const Record& record, const Correction& correction);

/// P-value of what a corrected fit leaves: smooth shapes, and all mechanisms.
double p_of_corrected(const Analysis& analysis, const CorrectedFit& corrected);

}  // namespace tunica::diagnosis
