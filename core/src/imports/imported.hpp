// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "importing/proposal.hpp"

/// `tunica import` without a terminal: the common part of the command line and Python.
namespace tunica::imports {

/// Options as the command line has them: lists of "NAME=VALUE", and words for all or for one.
struct ImportRequest {
  importing::Answers answers;
  std::vector<std::string> files, options, columns, units, where, directions, compressions;
  std::string table, output;
  bool join = false;
};

/// The written experiment, and the remarks on it.
struct Imported {
  std::filesystem::path file;
  importing::Json experiment;
  std::vector<std::string> notes;       ///< what was understood of the files
  std::vector<std::string> understood;  ///< "strip: stretch = 1 + displacement / 20 mm, …"
  std::vector<std::string> warnings;    ///< what `tunica check` warns of
  bool in_order = false;                ///< `tunica check` would end with 0
};

/// Reads the files, writes the experiment and checks it as `tunica check` does; what that refuses is taken back.
/// `ask` is asked what the files do not say; where it is empty, all that is missing is one InputError, which names the
/// options that answer. `making`, if any, hears which files will be written before the first one is; where the work
/// ends in an exception they are taken back.
Imported import_files(ImportRequest request, const plugins::Catalogue& catalogue, const importing::Ask& ask,
                      const std::function<void(const std::vector<std::filesystem::path>&)>& making = {});

}  // namespace tunica::imports
