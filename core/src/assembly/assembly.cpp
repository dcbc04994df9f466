// SPDX-License-Identifier: Apache-2.0
#include "assembly/assembly.hpp"

#include "assembly/builder.hpp"

namespace tunica::assembly {

Assembly::Assembly(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                   const plugins::Catalogue& catalogue)
    : Assembly(Builder(experiment, run, catalogue).build()) {}

Assembly::Assembly(Parts parts)
    : layout_(std::move(parts.layout)),
      models_(std::move(parts.models), std::move(parts.strips), parts.largest_stretch),
      box_(layout_.parameters),
      constraints_(models_, std::move(parts.constraints)),
      evaluator_(layout_, models_, constraints_, std::move(parts.tests), std::move(parts.fitted),
                 std::move(parts.priors)) {}

}  // namespace tunica::assembly
