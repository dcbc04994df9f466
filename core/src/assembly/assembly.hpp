// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "assembly/constraints.hpp"
#include "assembly/evaluator.hpp"
#include "assembly/layout.hpp"
#include "assembly/models.hpp"
#include "assembly/unit_box.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::assembly {

struct Parts;

/// One run's models (with mechanisms) and tests (bound to their data), grouped by purpose. Const and thread-safe after
/// construction.
class Assembly {
 public:
  /// Reads the data, builds model and tests through the plugins' factories, binds names, shares and fixed values.
  /// Throws InputError, and plugins::PluginFailure where a plugin breaks its promise.
  Assembly(const experiment::Experiment& experiment, const experiment::RunEntry& run,
           const plugins::Catalogue& catalogue);
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  [[nodiscard]] const Layout& layout() const { return layout_; }  ///< models, tests, channels and parameters
  [[nodiscard]] const Models& models() const { return models_; }  ///< the models themselves
  [[nodiscard]] const UnitBox& box() const { return box_; }       ///< the coordinates of the search
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }  ///< c(p) ≤ 0
  [[nodiscard]] const Evaluator& evaluator() const { return evaluator_; }        ///< predictions and objective

 private:
  explicit Assembly(Parts parts);

  // Later ones refer to earlier ones.
  const Layout layout_;
  const Models models_;
  const UnitBox box_;
  const Constraints constraints_;
  const Evaluator evaluator_;
};

}  // namespace tunica::assembly
