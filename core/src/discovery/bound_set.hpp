// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "discovery/kinds.hpp"
#include "discovery/subject.hpp"

namespace tunica::discovery {

/// Where the parameters of a term stand among the free ones of its assembly.
struct BoundTerm {
  std::string name;                  ///< "I2_linear", or "I2_linear_2" of a second one
  std::size_t amplitude = 0;         ///< for `added_term` nothing where it is 0
  std::vector<std::size_t> heights;  ///< of a curve: the other amplitudes
  std::vector<std::size_t> shapes;   ///< in the order of the kind
};

/// The subject with terms, bound to its data.
class BoundSet {
 public:
  /// Throws InputError where a term cannot act there.
  BoundSet(const Subject& subject, const std::vector<KindPointer>& kinds);

  [[nodiscard]] const assembly::Assembly& assembly() const { return *assembly_; }
  [[nodiscard]] const experiment::Experiment& experiment() const { return experiment_; }
  [[nodiscard]] const std::vector<BoundTerm>& terms() const { return terms_; }  ///< one a kind, in their order

 private:
  experiment::Experiment experiment_;
  std::unique_ptr<assembly::Assembly> assembly_;
  std::vector<BoundTerm> terms_;
};

/// The index of a free parameter of a term; throws std::logic_error where there is none.
std::size_t index_of(const assembly::Assembly& assembly, const Subject& subject, const std::string& term,
                     const std::string& name);

}  // namespace tunica::discovery
