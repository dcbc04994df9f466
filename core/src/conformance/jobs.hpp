// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/plugin_check.hpp"

namespace tunica::conformance {

/// A check that has yet to run.
struct Job {
  Finding head;  ///< without verdict
  std::function<Verdict()> check;
};
using Jobs = std::vector<Job>;

/// The inputs of the jobs; it outlives them.
struct CheckContext {
  const plugins::Catalogue& catalogue;
  const CheckSettings& settings;
};

Jobs model_jobs(const std::string& type, const CheckContext& context);
Jobs test_jobs(const std::string& type, const CheckContext& context);
Jobs optimizer_jobs(const std::string& type, const CheckContext& context);
Jobs mechanism_jobs(const std::string& id, const CheckContext& context);

/// Every property of a list, for a subject that `make` makes anew for each.
template <class Subject, class Make>
void add_properties(Jobs& jobs, Finding head, const std::vector<PropertyOf<Subject>>& properties, std::uint64_t seed,
                    const Make& make) {
  for (const PropertyOf<Subject>& property : properties) {
    head.property = property.name;
    head.advisory = property.advisory;
    jobs.push_back({head, [make, property, seed] {
                      return make([&](const Subject& subject) { return property.check(subject, seed); });
                    }});
  }
}

inline void add(Jobs& jobs, Finding head, const char* property, std::function<Verdict()> check) {
  head.property = property;
  head.advisory = false;
  jobs.push_back({std::move(head), std::move(check)});
}

}  // namespace tunica::conformance
