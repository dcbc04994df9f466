// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tunica/optimizer.hpp"
#include "tunica/options.hpp"

namespace tunica::pagmo_plugin {

enum class Method { sade, de1220, pso, ga, cmaes };

/// A search of pagmo. The plugin consists of two files: pagmo.so declares, and pagmo.search, which it loads here, is
/// linked to libpagmo. When that library is loaded, it fills its tables of benchmark functions (CEC 2013 and 2014).
/// This takes as long as all plugins of tunica together, so only those wait for it who search with pagmo.
std::unique_ptr<Optimizer> search_with(Method method, const Options& given);

}  // namespace tunica::pagmo_plugin

/// What pagmo.search exports.
extern "C" __attribute__((visibility("default"))) tunica::Optimizer* tunica_pagmo_search(
    tunica::pagmo_plugin::Method method, const tunica::Options& given);
