// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "uncertainty/bootstrap.hpp"
#include "uncertainty/profile.hpp"

namespace tunica::comparison {

struct RunProfiles {
  const assembly::Assembly* assembly;
  std::string label;
  std::vector<uncertainty::Profile> profiles;
};

struct RunDraws {
  const assembly::Assembly* assembly;
  std::string label;
  uncertainty::Bootstrap bootstrap;
};

/// profile_<parameter>.csv, one file a parameter for all runs that have it.
void write_profiles(const std::filesystem::path& directory, const std::vector<RunProfiles>& runs);
/// bootstrap.csv; not written without runs.
void write_bootstrap(const std::filesystem::path& directory, const std::vector<RunDraws>& runs);

}  // namespace tunica::comparison
