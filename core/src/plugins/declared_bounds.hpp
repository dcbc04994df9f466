// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tunica/options.hpp"
#include "tunica/parameter.hpp"

namespace tunica::plugins {

/// The fault in the default of an option: another kind than declared, none of the choices, or outside its bounds. Empty
/// = no fault. The host fills in defaults silently, so no other check would find it.
std::string flaw_of_default(const Option& option);

/// The same of the bounds and the initial value of a parameter.
std::string flaw_of_default(const Parameter& parameter);

/// The first flaw of all; empty = none.
template <class Declared>
std::string first_flaw(const std::vector<Declared>& all) {
  for (const Declared& one : all)
    if (std::string flaw = flaw_of_default(one); !flaw.empty()) return flaw;
  return {};
}

/// Throws InputError where two parameters of an object share a name: a file could not say which one it means. `noun` is
/// "model" or "test".
void refuse_equal_names(const std::vector<Parameter>& parameters, const std::string& plugin, const char* noun);

}  // namespace tunica::plugins
