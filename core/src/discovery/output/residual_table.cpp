// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/output/outputs.hpp"
#include "discovery/output/outputs.hpp"

namespace tunica::discovery {

std::string residual_table(const Discovery& d) {
  const diagnosis::Evidence& evidence = d.analysis.evidence;
  if (!d.best || d.terms.empty()) return diagnosis::residual_table(evidence, nullptr, nullptr, {});
  return diagnosis::residual_table(evidence, &d.best->set->assembly(), &d.best->fit, {});
}

}  // namespace tunica::discovery
