// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tunica/plugin.hpp"

namespace tunica::plugins {

/// Everything the loaded plugins provide, by name. Each entry remembers its plugin.
class Catalogue {
 public:
  template <class Factory>
  struct Entry {
    Factory factory;
    std::string plugin;  ///< "gho 0.1.0"
  };
  template <class Factory>
  using Entries = std::map<std::string, Entry<Factory>, std::less<>>;

  [[nodiscard]] const Entries<ModelFactory>& models() const { return models_; }
  [[nodiscard]] const Entries<TestFactory>& tests() const { return tests_; }
  [[nodiscard]] const Entries<OptimizerFactory>& optimizers() const { return optimizers_; }
  [[nodiscard]] const Entries<MechanismFactory>& mechanisms() const { return mechanisms_; }

  // Roles that a plugin's author assigns. The core looks them up instead of names; nullptr: no plugin has the role.
  /// The model that discovery writes terms in, ModelFactory::writes_terms.
  [[nodiscard]] const Entry<ModelFactory>* term_model() const;
  /// The mechanism by which it adds a term to another model, MechanismFactory::writes_terms.
  [[nodiscard]] const Entry<MechanismFactory>* term_mechanism() const;
  /// The optimizer that refines a fit, OptimizerFactory::refines.
  [[nodiscard]] const Entry<OptimizerFactory>* refiner() const;
  /// The test and the model that `import` proposes for files of a specimen, TestFactory::first_choice and
  /// ModelFactory::first_choice.
  [[nodiscard]] const Entry<TestFactory>* first_test(Specimen specimen) const;
  [[nodiscard]] const Entry<ModelFactory>* first_model(Specimen specimen) const;

  /// Takes over what one plugin has registered, all or nothing; throws std::invalid_argument on a name that is
  /// taken (by which plugin is in the message) or not a plain identifier, and on a default outside its own bounds. A
  /// model whose parameters begin outside their bounds is refused with an InputError when it is made.
  class Registration;
  void commit(Registration&& registration, const std::string& plugin);

 private:
  Entries<ModelFactory> models_;
  Entries<TestFactory> tests_;
  Entries<OptimizerFactory> optimizers_;
  Entries<MechanismFactory> mechanisms_;
};

/// The registry a plugin sees while it registers; nothing counts until commit().
class Catalogue::Registration : public Registry {
 public:
  void add(ModelFactory factory) override { models.push_back(std::move(factory)); }
  void add(TestFactory factory) override { tests.push_back(std::move(factory)); }
  void add(OptimizerFactory factory) override { optimizers.push_back(std::move(factory)); }
  void add(MechanismFactory factory) override { mechanisms.push_back(std::move(factory)); }

  std::vector<ModelFactory> models;
  std::vector<TestFactory> tests;
  std::vector<OptimizerFactory> optimizers;
  std::vector<MechanismFactory> mechanisms;
};

}  // namespace tunica::plugins
