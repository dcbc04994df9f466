// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "plugins/catalogue.hpp"

/// The project is a folder: experiments, files of rigs and results in it, and .tunica-studio for what the studio keeps.
/// The working folder of the process is the project, so that every command that is shown works there.
namespace tunica::app::studio {

/// ".tunica-studio", made where it is missing.
std::filesystem::path own_place();

/// A name as the page says it, relative to the project, that may or may not exist yet. Throws Refused where it leaves
/// the folder, by "..", by a symbolic link or by being absolute, and where a part of it is hidden or no plain text.
/// Nor does a name begin with "-", which a command would take for an option.
std::filesystem::path inside(const std::string& name);
/// The same of a file that is there; throws InputError where it is not, or is no regular file.
std::filesystem::path file_inside(const std::string& name);
/// The same of any path of a file that an experiment names: it has to lie in the project, wherever it is written from.
void require_inside(const std::filesystem::path& file, const std::string& named_by);

/// A name for a new file from what somebody calls it: the last part of a path, no leading dots, letters, digits and
/// "._- " as they are, everything else as "-".
std::string file_name(std::string_view wished);
/// "strip.csv", or "strip-2.csv" where that is taken, and so on. Nobody else in this process gets the name until it is
/// given back, be the file there or not; one process serves a project.
std::filesystem::path free_name(const std::filesystem::path& wished);
void give_back(const std::filesystem::path& name);
/// A free name for as long as this object lives.
struct FreeName {
  std::filesystem::path file;
  explicit FreeName(const std::filesystem::path& wished) : file(free_name(wished)) {}
  ~FreeName() { give_back(file); }
  FreeName(const FreeName&) = delete;
  FreeName& operator=(const FreeName&) = delete;
};
/// A hidden name that no other call has given, of a file that goes again.
std::string passing_name();

/// What there is: {"experiments": [name], "data": [name], "results": [{"folder", "kind", …}]}, newest results first,
/// and "copies", see copies().
nlohmann::ordered_json contents();

/// The worked examples that were installed: [{"name", "title", "learnt"}].
nlohmann::ordered_json examples();
/// What was measured in one, to be drawn small: of its first tests [{"test", "over", "observable", "unit", "x", "y"}],
/// the first channel over the first abscissa in base units. Throws InputError.
nlohmann::ordered_json example_curves(const std::string& name, const plugins::Catalogue& catalogue);
/// Copies one, with the files of others that it names, and returns the experiment file. Throws InputError.
std::string open_example(const std::string& name);

}  // namespace tunica::app::studio
