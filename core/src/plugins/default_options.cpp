// SPDX-License-Identifier: Apache-2.0
#include "plugins/default_options.hpp"

namespace tunica::plugins {

Options default_options(const std::vector<Option>& declared) {
  Options options;
  for (const Option& option : declared)
    if (option.fallback) options.set(option.name, *option.fallback);
  return options;
}

Options with_options_of_test(Options own, const Options& test) {
  for (const auto& [name, value] : test.values())
    if (!own.has(name)) own.set(name, value);
  return own;
}

}  // namespace tunica::plugins
