// SPDX-License-Identifier: Apache-2.0
#include "plugins/trust.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tunica::plugins {

namespace fs = std::filesystem;

namespace {

/// The library or program that this code is part of: its owner can run code as the user anyway.
void code_of_this_program() {}

std::vector<uid_t> trusted_owners() {
  std::vector<uid_t> owners{0, ::geteuid()};
  struct stat status {};
  if (::stat("/proc/self/exe", &status) == 0) owners.push_back(status.st_uid);
  Dl_info place{};
  if (::dladdr(reinterpret_cast<const void*>(&code_of_this_program), &place) != 0 && place.dli_fname != nullptr &&
      std::string_view(place.dli_fname).starts_with('/') && ::stat(place.dli_fname, &status) == 0)
    owners.push_back(status.st_uid);
  return owners;
}

/// The group that many systems give to each user, of the same name and without other members.
bool is_private_group(uid_t owner, gid_t group) {
  const passwd* user = ::getpwuid(owner);
  if (user == nullptr || user->pw_gid != group) return false;
  const std::string name = user->pw_name;
  const ::group* members = ::getgrgid(group);
  return members != nullptr && name == members->gr_name &&
         (members->gr_mem == nullptr || *members->gr_mem == nullptr || *members->gr_mem == name);
}

std::string user_name(uid_t id) {
  const passwd* user = ::getpwuid(id);
  return user != nullptr ? fmt::format("'{}'", user->pw_name) : fmt::format("number {}", id);
}

constexpr std::string_view otherwise = " (or pass --allow-world-writable-plugins)";

/// `who` is "the file", "its folder", "the folder '/a' above it"; `harm` what others could do.
std::string distrust(const fs::path& path, std::string_view who, std::string_view harm, bool sticky_is_fine) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  static const std::vector<uid_t> owners = trusted_owners();
  if (std::find(owners.begin(), owners.end(), status.st_uid) == owners.end())
    return fmt::format(
        "{} belongs to the user {}, who could {}; expected one that belongs to you or to root; take a copy of your "
        "own{}",
        who, user_name(status.st_uid), harm, otherwise);
  const std::string_view kind = S_ISDIR(status.st_mode) ? "folder" : "file";
  if (sticky_is_fine && (status.st_mode & S_ISVTX) != 0) return {};
  if ((status.st_mode & S_IWOTH) != 0)
    return fmt::format(
        "{} can be written by every user, so that any of them could {}; expected a {} writable by its owner only; run: "
        "chmod o-w '{}'{}",
        who, harm, kind, path.string(), otherwise);
  if ((status.st_mode & S_IWGRP) != 0 && !is_private_group(status.st_uid, status.st_gid))
    return fmt::format(
        "{} can be written by its group, so that any member could {}; expected a {} writable by its owner only; run: "
        "chmod g-w '{}'{}",
        who, harm, kind, path.string(), otherwise);
  return {};
}

}  // namespace

std::string distrust(const fs::path& file) {
  std::error_code error;
  if (std::string reason = distrust(file, "the file", "run code as you", false); !reason.empty()) return reason;
  const fs::path stated = fs::absolute(file), real = fs::canonical(file, error);
  for (const fs::path& place : stated == real ? std::vector{stated} : std::vector{stated, real}) {
    fs::path folder = place.parent_path();
    if (std::string reason = distrust(folder, "its folder", "replace it", false); !reason.empty()) return reason;
    while (folder.has_relative_path()) {
      folder = folder.parent_path();
      const std::string who = fmt::format("the folder '{}' above it", folder.string());
      if (std::string reason = distrust(folder, who, "replace what lies below", true); !reason.empty()) return reason;
    }
  }
  return {};
}

}  // namespace tunica::plugins
