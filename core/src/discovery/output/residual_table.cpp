// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "discovery/output/outputs.hpp"

namespace tunica::discovery {

std::string residual_table(const Discovery& d) {
  const diagnosis::Evidence& evidence = d.analysis.evidence;
  const Eigen::VectorXd& left = d.best ? d.best->fit.residuals : evidence.fit.residuals;
  std::string text = "test,channel,row,abscissa,measured,residual_base,residual_terms\n";
  for (const diagnosis::Curve& curve : evidence.curves)
    for (const assembly::MeasuredChannel& view : evidence.base->layout().channels) {
      if (view.test != curve.test || view.observable != curve.channel) continue;
      for (Eigen::Index i = 0; i < curve.count; ++i) {
        const std::size_t row = curve.rows[static_cast<std::size_t>(i)];
        text += fmt::format("{},{},{},{:.10g},{:.10g},{:.6g},{:.6g}\n", curve.test, curve.channel, view.file_row(row),
                            curve.abscissa[static_cast<std::size_t>(i)], view.measured[row],
                            evidence.fit.residuals[curve.first + i], left[curve.first + i]);
      }
    }
  return text;
}

}  // namespace tunica::discovery
