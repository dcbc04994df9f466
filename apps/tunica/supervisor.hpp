// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace tunica::app {

/// Runs `work` in a child process and waits. Where a plugin takes the child down, another one takes up the work, knows
/// which call it was and does not make it again. So a crash costs one evaluation; no plugin code runs in this process.
///
/// Signals: SIGINT, SIGTERM and SIGHUP go on to the child. A second one of any kind ends it, and so does the first one
/// where the child does not stop within a few seconds. Returns the exit code of the program.
int supervise(const std::function<int()>& work);

/// Messages of the child to its supervisor. The calls have no effect in a process without a supervisor.
namespace supervised {

/// The work of this process was begun by another one.
bool successor();
/// Results go to this folder, and work that is done there is taken up: a successor finds its name here.
void resumable_in(const std::filesystem::path& folder);
/// The folder of the predecessor, or empty.
std::filesystem::path resumable_folder();
/// Files and folders that were not there when the work began, the innermost first, and a folder `results` that was
/// empty. Where the work ends in the middle they are removed, and a successor finds all as it was.
void unfinished(const std::vector<std::filesystem::path>& made, const std::filesystem::path& results = {});
/// Something was printed that a successor would print again: there must be none.
void answered();
/// The printed text is the address of the server, so a successor continues without printing it.
void serves();
/// Keeps a descriptor for a successor.
void park(int descriptor);
/// The one of the predecessor, or -1.
int parked();

}  // namespace supervised
}  // namespace tunica::app
