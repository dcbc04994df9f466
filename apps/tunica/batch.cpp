// SPDX-License-Identifier: Apache-2.0
#include "batch.hpp"

#include <algorithm>
#include <atomic>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "answer.hpp"
#include "execution/share.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "text/aside.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

int run_batch(
    const Batch& batch,
    const std::function<void(const std::filesystem::path& of_case, const std::filesystem::path& results)>& make) {
  if (!std::filesystem::is_directory(batch.root))
    throw InputError(fmt::format("--batch {}: no such folder. Name one that holds folders with an experiment.json each",
                                 batch.root.string()));
  const std::filesystem::path into = batch.into.empty() ? batch.root : std::filesystem::path(batch.into);
  const auto share = batch.share.empty() ? execution::Share{} : execution::parse_share(batch.share);
  std::vector<std::filesystem::path> all, cases;
  for (const auto& entry : std::filesystem::directory_iterator(batch.root))
    if (std::filesystem::exists(entry.path() / "experiment.json")) all.push_back(entry.path());
  if (all.empty())
    throw InputError(
        fmt::format("--batch {}: holds no folder with an experiment.json. Name one that does", batch.root.string()));
  std::sort(all.begin(), all.end());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (share.holds(k) && !std::filesystem::exists(into / all[k].filename() / "result.json")) cases.push_back(all[k]);
  std::atomic<std::size_t> failures = 0, finished = 0;
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t k) {
    // A case runs its own loops side by side; here its neighbours do.
    tbb::this_task_arena::isolate([&] {
      try {
        make(cases[k], into / cases[k].filename());
      } catch (const std::exception& problem) {
        ++failures;
        say_error(fmt::format("{}: {}", cases[k].string(), problem.what()));
      }
    });
    if (const std::size_t n = ++finished; !batch.quiet && (n % 50 == 0 || n == cases.size()))
      text::aside("{} of {} {}\n", n, cases.size(), batch.many);
  });
  answer("{} {} made, {} failed\n", cases.size() - failures, batch.many, failures.load());
  return failures == 0 ? done : not_converged;
}

}  // namespace tunica::app
