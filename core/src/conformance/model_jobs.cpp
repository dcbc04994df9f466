// SPDX-License-Identifier: Apache-2.0
#include "conformance/declarations.hpp"
#include "conformance/jobs.hpp"
#include "conformance/model_properties.hpp"
#include "conformance/optimizer_properties.hpp"
#include "conformance/option_values.hpp"
#include "plugins/guarded.hpp"

namespace tunica::conformance {

Jobs model_jobs(const std::string& type, const CheckContext& context) {
  const auto& entry = context.catalogue.models().find(type)->second;
  const Finding head{"model", type, "", ""};
  const auto made = [&entry] { return plugins::create_bare(entry, plausible_options(entry.factory.options)); };
  Jobs jobs;
  add(jobs, head, "declaration_is_complete", [&entry] { return declaration_is_complete(entry.factory); });
  add(jobs, head, "parameters_are_declared", [made, type] {
    const auto model = made();
    if (model->describe().type != type)
      return broken("the type of the description with that of the factory",
                    "the model calls itself '" + model->describe().type + "', and is registered as '" + type + "'");
    return parameters_are_declared(model->describe().parameters);
  });
  add(jobs, head, "is_made_with_every_option", [&entry] {
    return made_with_every_option(entry.factory.options, [&](const Options& o) { plugins::create_bare(entry, o); });
  });
  add_properties(jobs, head, model_properties(), context.settings.seed,
                 [made](const auto& check) { return check(*made()); });
  return jobs;
}

Jobs optimizer_jobs(const std::string& type, const CheckContext& context) {
  const auto& entry = context.catalogue.optimizers().find(type)->second;
  const Finding head{"optimizer", type, "", ""};
  Jobs jobs;
  add(jobs, head, "declaration_is_complete", [&entry] { return declaration_is_complete(entry.factory); });
  add(jobs, head, "is_made_with_every_option", [&entry] {
    return made_with_every_option(entry.factory.options, [&](const Options& o) { plugins::create(entry, o); });
  });
  add_properties(jobs, head, optimizer_properties(), context.settings.seed, [&entry](const auto& check) {
    return check(Candidate{[&entry] { return plugins::create(entry, plausible_options(entry.factory.options)); }});
  });
  return jobs;
}

}  // namespace tunica::conformance
