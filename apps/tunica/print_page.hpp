// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::app {

/// Prints reports of result folders into a PDF, by a browser that is installed: Chromium, Chrome or Edge, or the
/// program that TUNICA_BROWSER names. It gets a profile of its own, which is removed with the page. Throws InputError
/// where there is no such browser, or it makes no PDF in two minutes, and execution::WriteFailure. Returns false after
/// Ctrl-C, which ends the browser.
[[nodiscard]] bool print_report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file);

}  // namespace tunica::app
