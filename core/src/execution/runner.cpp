// SPDX-License-Identifier: Apache-2.0
#include "execution/runner.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "execution/checkpoint.hpp"
#include "execution/files.hpp"
#include "execution/first_failure.hpp"
#include "execution/interrupt.hpp"
#include "execution/journal.hpp"
#include "execution/realisation.hpp"
#include "execution/recovery.hpp"
#include "execution/thinning.hpp"
#include "text/escaped.hpp"

namespace tunica::execution {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds heartbeat{100};  // of the thread that writes rows to the disk
constexpr std::chrono::seconds checkpoint_interval{1};

/// run.log, opened like every other file of a run.
class LogFile : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit LogFile(const std::filesystem::path& file) : file_(file) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    const std::string_view text(line.data(), line.size());  // with the end of the line
    file_.append(text::escaped(text.substr(0, text.size() - 1)) + "\n");
  }
  void flush_() override {}

  AppendFile file_;
};

/// State of one execution. Searches write their own results, the journal, the meters and `ended_`. The pulse thread
/// makes files durable, so no search waits for the disk unless too many rows are pending.
class Run {
 public:
  Run(const Plan& plan, const RunSettings& settings)
      : plan_(plan),
        settings_(settings),
        table_(plan.table()),
        meters_(plan.tasks.size()),
        results_(plan.tasks.size()),
        stored_(plan.tasks.size()) {
    log_ = std::make_shared<spdlog::logger>("run", std::make_shared<LogFile>(settings.directory / "run.log"));
    log_->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    log_->set_error_handler([](const std::string&) {});  // a full disk is reported by the journal
    open();
  }

  Execution execute();

 private:
  void open();
  void work();
  void run_task(std::size_t task);
  void settle();
  void save();
  bool stopping() const { return InterruptWatch::interrupted() || journal_->failed() || broken_; }

  const Plan& plan_;
  const RunSettings& settings_;
  EvaluationTable table_;
  std::vector<Meter> meters_;
  std::vector<RealisationResult> results_;  ///< per task
  std::vector<StoredEvaluations> stored_;
  std::unique_ptr<Journal> journal_;
  std::shared_ptr<spdlog::logger> log_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> broken_ = false;  ///< an exception is pending, or the checkpoint cannot be written
  FirstFailure failure_;              ///< of a search
  std::string write_failure_;         ///< of the checkpoint
  std::mutex mutex_;                  ///< of `ended_`
  std::vector<std::size_t> ended_;    ///< finished searches whose rows are not closed yet
  Facts facts_;
  std::map<std::size_t, std::string> finished_;  ///< entries of the checkpoint, by task
  Clock::time_point saved_ = Clock::now();
  bool unsaved_ = false;
};

void Run::open() {
  const auto& directory = settings_.directory;
  const auto& input = plan_.experiment->input_json;
  facts_ = facts_of(plan_);
  Journal::Stored stored;
  if (settings_.resume) {
    Checkpoint before = read_checkpoint(directory);
    refuse_changes(directory, before.facts, facts_, input);
    write_atomically(directory / "input.json", input);  // it may ask for another analysis
    std::vector<bool> wanted(plan_.tasks.size(), true);
    for (const auto& [task, result] : before.finished)
      if (task < wanted.size()) wanted[task] = false;
    facts_.thinned = before.facts.thinned;
    if (facts_.thinned) refuse_unfinished(directory, before, plan_.tasks.size());
    const auto own = [this](const auto& entry) { return settings_.share.holds(entry.first); };
    std::size_t asked = 0;
    for (std::size_t task = 0; task < plan_.tasks.size(); ++task) asked += settings_.share.holds(task);
    if (static_cast<std::size_t>(std::count_if(before.finished.begin(), before.finished.end(), own)) < asked)
      refuse_other_level(directory, before.facts.vector_level, facts_.vector_level);
    facts_.vector_level = before.facts.vector_level;
    auto recovered =
        facts_.thinned ? thinned_journal(before, plan_.tasks.size()) : recover(directory, table_, plan_.tasks, wanted);
    for (const auto* damages : {&before.damages, &recovered.damages})
      for (const std::string& sentence : *damages) {
        log_->warn("{}", sentence);
        if (settings_.noticed) settings_.noticed(sentence);
      }
    for (auto& [task, result] : before.finished) {
      // A finished realisation that lost rows (loss of power) counts as unfinished and starts again.
      if (task >= wanted.size() || recovered.stored.rows[task] != result.tally.evaluations) continue;
      finished_[task] = checkpoint_entry(task, result);
      results_[task] = std::move(result);
    }
    stored_ = std::move(recovered.evaluations);
    stored = std::move(recovered.stored);
    log_->info("resumed: {} of {} realisations are finished, the others are replayed from evaluations.csv",
               finished_.size(), plan_.tasks.size());
  } else {
    write_atomically(directory / "input.json", input);
    log_->info("experiment '{}', seed {}, {} threads", plan_.experiment->name, plan_.experiment->seed,
               settings_.threads);
  }
  for (const auto& warning : plan_.warnings) log_->warn("{}", warning.text());
  journal_ = std::make_unique<Journal>(directory, table_, plan_.tasks, std::move(stored));
  // If there are more threads than searches, an idle one can write.
  constexpr std::size_t of_few_searches = 1 << 16;
  if (plan_.tasks.size() < settings_.threads) journal_->let_wait(of_few_searches / plan_.tasks.size());
  std::vector<std::size_t> ended;
  for (const auto& [task, entry] : finished_) {
    const auto& result = results_[task];
    ended.push_back(task);
    meters_[task].evaluations = result.tally.evaluations;
    meters_[task].best = result.best.parameters.empty() ? meters_[task].best.load() : result.best.objective;
    meters_[task].finished = true;
  }
  if (!ended.empty()) journal_->finish(ended);
  write_checkpoint(directory, facts_, finished_);
}

/// Closes the rows of ended searches; the checkpoint lists them every second.
void Run::settle() {
  std::vector<std::size_t> ended;
  {
    const std::lock_guard lock(mutex_);
    ended.swap(ended_);
  }
  if (!ended.empty()) journal_->finish(ended);
  for (const std::size_t task : ended) {
    finished_[task] = checkpoint_entry(task, results_[task]);
    unsaved_ = true;
  }
  if (unsaved_ && Clock::now() - saved_ >= checkpoint_interval) save();
}

/// Writes the rows first, then the checkpoint that relies on them.
void Run::save() {
  journal_->flush(true);
  if (journal_->failed()) return;
  try {
    write_checkpoint(settings_.directory, facts_, finished_);
  } catch (const WriteFailure& problem) {
    write_failure_ = problem.what();
    broken_ = true;
  }
  saved_ = Clock::now();
  unsaved_ = false;
}

void Run::run_task(std::size_t task) {
  const auto& [run_index, realisation] = plan_.tasks[task];
  const auto& run = plan_.runs[run_index];
  auto& meter = meters_[task];
  meter.running = true;
  log_->info("{}, realisation {}: begins", run.label, realisation);
  Surroundings surroundings;
  surroundings.record = [&](const search::Record& record) {
    journal_->record(task, record);
    meter.count(record);
  };
  surroundings.replay = [&](std::uint64_t index, search::JournalEntry& entry) {
    return stored_[task].get(index, entry);
  };
  surroundings.interrupted = [this] { return stopping(); };
  auto result = run_realisation(run, realisation, *plan_.experiment, surroundings);
  stored_[task] = {};
  meter.running = false;
  log_->info("{}, realisation {}: {} after {} evaluations ({} failed), {:.3f} s, best {}{}{}", run.label, realisation,
             result.finished ? "ends" : "interrupted", result.tally.evaluations, result.tally.failures, result.seconds,
             result.best.parameters.empty() ? "none" : fmt::format("{}", result.best.objective),
             result.stop_sentence.empty() ? "" : ", stopped by " + result.stop_sentence,
             result.reason.empty() ? "" : ": " + result.reason);
  if (result.tally.failures > 0)
    log_->warn("{}, realisation {}: first failure: {}", run.label, realisation, result.tally.first_failure);
  results_[task] = std::move(result);
  if (!results_[task].finished) return;
  meter.finished = true;
  const std::lock_guard lock(mutex_);
  ended_.push_back(task);
}

void Run::work() {
  for (std::size_t task = next_++; task < plan_.tasks.size() && !stopping(); task = next_++) {
    if (results_[task].finished || !settings_.share.holds(task)) continue;
    // Without isolation, a thread that waits for its population could start another whole realisation.
    tbb::this_task_arena::isolate([&] { failure_.guard([&] { run_task(task); }); });
    if (failure_.any()) broken_ = true;
  }
}

Execution Run::execute() {
  const auto begin = Clock::now();
  Progress progress(settings_.progress, plan_, meters_, settings_.share);
  std::mutex waiting;
  std::condition_variable wake;
  bool over = false;
  std::thread pulse([&] {
    for (std::unique_lock lock(waiting); !wake.wait_for(lock, heartbeat, [&] { return over; });) {
      failure_.guard([this] { settle(); });
      if (failure_.any()) broken_ = true;
      journal_->flush();
      progress.draw();
      if (settings_.told) settings_.told(progress.share(), progress.text(progress.seconds()));
    }
  });
  failure_.guard([&] {
    const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, settings_.threads);
    tbb::task_arena arena(static_cast<int>(settings_.threads));
    const std::size_t workers = std::min<std::size_t>(settings_.threads, plan_.tasks.size());
    arena.execute([&] {
      tbb::parallel_for(
          std::size_t{0}, workers, [&](std::size_t) { work(); }, tbb::simple_partitioner());
    });
  });
  {
    const std::lock_guard lock(waiting);
    over = true;
  }
  wake.notify_all();
  pulse.join();
  progress.draw(true);
  failure_.guard([this] { settle(); });
  journal_->flush();
  if (failure_.any()) log_->error("ended by an error; the evaluations so far are in evaluations.csv");
  failure_.rethrow();
  Execution execution;
  if (!broken_) save();
  execution.write_failure = journal_->failed() ? journal_->failure() : write_failure_;
  execution.runs.resize(plan_.runs.size());
  for (std::size_t task = 0; task < results_.size(); ++task) {
    if (!results_[task].finished && settings_.share.holds(task)) execution.interrupted = true;
    execution.runs[plan_.tasks[task].run].realisations.push_back(std::move(results_[task]));
  }
  execution.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  log_->info("{} after {:.3f} s", execution.interrupted ? "interrupted" : "done", execution.seconds);
  return execution;
}

}  // namespace

Execution execute(const Plan& plan, const RunSettings& settings) { return Run(plan, settings).execute(); }

}  // namespace tunica::execution
