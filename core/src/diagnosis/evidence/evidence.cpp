// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/evidence.hpp"

#include <utility>

#include "diagnosis/evidence/base_fit.hpp"
#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/evidence/preparation.hpp"

namespace tunica::diagnosis {

Evidence evidence_of(const Inquiry& inquiry, const std::vector<GrossRow>& gross) {
  Preparation prepared = prepare(inquiry, gross);
  const BaseFit fitted = fit_base(inquiry, prepared);
  SettledFit settled = settle_noise(inquiry, prepared, fitted.fit);
  Evidence evidence{std::move(settled.experiment), std::move(prepared.run),
                    std::move(prepared.noise),     gross,
                    std::move(settled.base),       std::move(prepared.curves),
                    std::move(settled.fit),        std::move(prepared.warnings)};
  evidence.warnings.insert(evidence.warnings.end(), fitted.warnings.begin(), fitted.warnings.end());
  for (const data::Finding& finding : evidence.base->layout().findings)
    evidence.warnings.push_back({WarningKind::record, finding.text});
  for (const std::string& text : evidence.base->layout().warnings)
    evidence.warnings.push_back({WarningKind::base_model, text});
  if (!has_open_noise(evidence)) return evidence;
  // Signatures are computed at a fit with approximately the final weight of every channel.
  return restated(inquiry, evidence, encompassing_noise(evidence, evidence.fit, {}));
}

assembly::Misfit stated_misfit(const Evidence& evidence) {
  double chi_square = 0;
  std::size_t rows = 0;
  for (const Curve& curve : evidence.curves) {
    if (curve.noise.kind != NoiseSource::Kind::stated) continue;
    chi_square += evidence.fit.residuals.segment(curve.first, curve.count).squaredNorm();
    rows += static_cast<std::size_t>(curve.count);
  }
  if (rows == 0) return {};
  return assembly::misfit_of(chi_square, rows, static_cast<std::size_t>(evidence.fit.residuals.size()),
                             evidence.base->layout().parameters.size());
}

}  // namespace tunica::diagnosis
