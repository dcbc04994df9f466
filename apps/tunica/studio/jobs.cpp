// SPDX-License-Identifier: Apache-2.0
#include "studio/jobs.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "exit_codes.hpp"
#include "studio/job_request.hpp"
#include "studio/progress_events.hpp"
#include "studio/project_folder.hpp"
#include "text/shell.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
using namespace std::chrono_literals;

namespace {

double now() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

int opened(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor < 0)
    throw InputError(fmt::format("{}: cannot be written; check the folder's permissions", file.string()));
  return descriptor;
}

/// A process of this program. It ends where its parent does, and signals of the terminal pass it by: it would take a
/// second one for impatience.
pid_t start_process(const std::vector<std::string>& arguments, int out, int err) {
  std::vector<std::string> words{"tunica"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const pid_t parent = ::getpid(), process = ::fork();
  if (process != 0) {
    if (nothing >= 0) ::close(nothing);
    return process;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(internal_error);
  ::setpgid(0, 0);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(number, SIG_DFL);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::execv("/proc/self/exe", argv.data());
  ::_exit(internal_error);
}

std::string state_of(const JobRecord& job, bool runs) {
  if (runs) return "running";
  if (!job.ended || !job.code) return "interrupted";
  if (*job.code == done) return "done";
  if (*job.code == not_converged) return "not_converged";
  if (*job.code == interrupted || job.asked_to_stop) return "stopped";
  return "failed";
}

}  // namespace

Jobs::Jobs(const Session& session, std::vector<std::string> plugins)
    : session_(session), plugins_(std::move(plugins)), watch_([this] { watch(); }) {}

Jobs::~Jobs() {
  constexpr auto patience = 3s;  // less than the supervisor has with this process
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, process] : running_) ::kill(process, SIGINT);
  }
  const auto limit = std::chrono::steady_clock::now() + patience;
  for (bool ended = false; !ended && std::chrono::steady_clock::now() < limit; std::this_thread::sleep_for(20ms)) {
    const std::lock_guard lock(mutex_);
    ended = running_.empty();
  }
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, process] : running_) ::kill(process, SIGKILL);
    over_ = true;
  }
  watch_.join();
}

json Jobs::start(const nlohmann::json& request) {
  constexpr std::size_t most = 4;
  const std::lock_guard one_at_a_time(starting_);
  std::unique_lock lock(mutex_);
  if (running_.size() >= most)
    throw InputError(fmt::format("{} jobs are running already; wait for one, or stop it", most));
  JobRecord job = job_of(session_, request);
  for (const auto& [id, process] : running_)
    if (!job.folder.empty() && find(id).folder == job.folder)
      throw InputError(fmt::format("a job writes to {} already; wait for it, or stop it", job.folder));
  job.id = next_job_id();
  job.started = now();
  launch(job, lock);
  return entry(job);
}

void Jobs::launch(JobRecord& job, std::unique_lock<std::mutex>& lock) {
  auto words = job.words;
  words.insert(words.end(), plugins_.begin(), plugins_.end());
  job.words = words;
  write_record(job);
  const std::array files{opened(job.file(".out")), opened(job.file(".err"))};
  pid_t process = -1;
  beginning_ = [&] { process = start_process(words, files[0], files[1]); };
  changed_.notify_all();
  changed_.wait(lock, [&] { return !beginning_; });
  for (const int file : files) ::close(file);
  if (process < 0) throw InputError("the system starts no further process; end some, and try again");
  running_[job.id] = process;
}

void Jobs::stop(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = running_.find(id);
  if (found == running_.end()) return;  // it has ended meanwhile
  JobRecord job = find(id);
  job.asked_to_stop = true;
  write_record(job);
  ::kill(found->second, SIGINT);
}

JobRecord Jobs::find(const std::string& id) {
  for (JobRecord& job : job_records())
    if (job.id == id) return job;
  throw InputError(fmt::format("there is no job '{}'; load the page again", text::quoted(id)));
}

json Jobs::entry(const JobRecord& job) const {
  std::vector<std::string> words{"tunica"};
  words.insert(words.end(), job.words.begin(), job.words.end());
  const bool runs = running_.contains(job.id);
  return {{"id", job.id},
          {"verb", job.verb},
          {"command", text::quoted(words)},
          {"folder", job.folder},
          {"readings", std::count(job.words.begin(), job.words.end(), "--groups") > 0},
          {"output", job.output},
          {"experiment", job.experiment},
          {"started", job.started},
          {"ended", job.ended ? json(*job.ended) : json(nullptr)},
          {"code", job.code ? json(*job.code) : json(nullptr)},
          {"state", state_of(job, runs)},
          {"resumable", !runs && job.is_resumable()},
          {"words", last_words_of(job)}};
}

json Jobs::all() {
  const std::lock_guard lock(mutex_);
  json list = json::array();
  for (const JobRecord& job : job_records()) list.push_back(entry(job));
  return list;
}

std::function<std::optional<std::string>()> Jobs::events(const std::string& id) {
  JobRecord job;
  {
    const std::lock_guard lock(mutex_);
    job = find(id);
  }
  return progress_events(job, [this, id]() -> std::optional<json> {
    const std::lock_guard lock(mutex_);
    if (running_.contains(id) && !over_) return std::nullopt;
    return entry(find(id));
  });
}

void Jobs::finish(const std::string& id, int status) {
  JobRecord job = find(id);
  job.ended = now();
  job.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::error_code not_empty;
  if (!job.folder.empty() && !fs::is_symlink(job.folder) && fs::is_empty(job.folder, not_empty))
    fs::remove(job.folder, not_empty);
  give_back(job.output);
  write_record(job);
}

void Jobs::watch() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait_for(lock, 30ms, [&] { return static_cast<bool>(beginning_); });
    if (beginning_) {
      beginning_();
      beginning_ = nullptr;
      changed_.notify_all();
    }
    for (auto one = running_.begin(); one != running_.end();) {
      int status = 0;
      if (::waitpid(one->second, &status, WNOHANG) != one->second) {
        ++one;
        continue;
      }
      try {
        finish(one->first, status);
      } catch (const std::exception&) {  // a disk that is full: the job is shown as interrupted
      }
      one = running_.erase(one);
    }
    if (over_ && running_.empty()) return;
  }
}

}  // namespace tunica::app::studio
