// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "assembly/assembly.hpp"
#include "diagnosis/evidence/curves.hpp"
#include "diagnosis/request.hpp"
#include "diagnosis/result.hpp"

namespace tunica::diagnosis {

/// The experiment for a diagnosis: every channel with its noise, weights of one, no constraints. It is a whitened
/// least-squares fit of one model to all tests of the first run, or to all tests if there is no run. Channels of weight
/// 0 are excluded. Rows of unknown order are sorted.
struct Preparation {
  experiment::Experiment experiment;
  experiment::RunEntry run;
  std::vector<NoiseSource> noise;
  std::shared_ptr<const assembly::Assembly> base;
  std::vector<Curve> curves;
  std::vector<Warning> warnings;
};

/// `gross` rows take no part in an estimate of the noise, nor in any fit.
Preparation prepare(const Inquiry& inquiry, const std::vector<GrossRow>& gross);

}  // namespace tunica::diagnosis
