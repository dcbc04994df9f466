// SPDX-License-Identifier: Apache-2.0
#include <exception>

#include "tunica/plugin.hpp"

namespace {

class DoesNothing : public tunica::Optimizer {
 public:
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(tunica::Problem&) override { return {true, "nothing to do"}; }

 private:
  Needs needs_;
};

/// Known to this library only, as a third party's exception types are.
struct OwnException : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "an exception of the plugin's own type"; }
};

}  // namespace

TUNICA_PLUGIN("good", "1.2.3") {
  registry.add(tunica::OptimizerFactory{"does_nothing", "Returns at once.", "", {}, [](const tunica::Options&) {
                                          return std::make_unique<DoesNothing>();
                                        }});
  registry.add(tunica::ModelFactory{
      "wrong_input", "Refuses its options.", "", {}, [](const tunica::Options&) -> std::unique_ptr<tunica::Model> {
        throw tunica::InputError("'layers' must be at least 1, found 0");
      }});
  registry.add(tunica::ModelFactory{
      "own_exception", "Fails.", "", {}, [](const tunica::Options&) -> std::unique_ptr<tunica::Model> {
        throw OwnException();
      }});
}
