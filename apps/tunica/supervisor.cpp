// SPDX-License-Identifier: Apache-2.0
#include "supervisor.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "exit_codes.hpp"
#include "messages.hpp"
#include "orphans.hpp"
#include "plugins/casualties.hpp"

namespace tunica::app {

namespace {

using Path = std::array<char, 4096>;

/// The memory that the supervisor shares with its children.
struct Shared {
  plugins::CasualtyList casualties;
  std::atomic<std::uint64_t> finished = 0;  ///< `the_end`: work() came to its end; `code` is what it returned
  std::atomic<int> code = 0;
  std::atomic<bool> answered = false, serves = false;
  std::atomic<unsigned> generation = 0;  ///< children before this one
  Path resumable = {}, disposable = {};
  std::array<Path, 4> unfinished = {};
};
constexpr std::uint64_t the_end = 0x746865'20656e64;  // what junk hardly is
Shared* common = nullptr;
/// A worker holds the shared memory closed but where it writes there itself. A plugin that writes anywhere is so found
/// in its call, and cannot lead its successor to other folders.
void set_shared(int protection) {
  if (common != nullptr) ::mprotect(common, sizeof(Shared), protection);
}
void open_shared() { set_shared(PROT_READ | PROT_WRITE); }

class SharedOpen {
 public:
  SharedOpen() { open_shared(); }
  ~SharedOpen() { set_shared(PROT_READ); }
  SharedOpen(const SharedOpen&) = delete;
  SharedOpen& operator=(const SharedOpen&) = delete;
};

/// A descriptor that was sent and not received stays open: that is where one is parked.
std::array<int, 2> parking{-1, -1};

constexpr std::array passed_on{SIGINT, SIGTERM, SIGHUP};
constexpr unsigned patience = 5;  // s, from the first signal to the end of a child that does not answer
constexpr double apart = 0.2;     // s; what comes sooner is the same wish, told to the process and to its group

volatile pid_t worker = 0;
volatile sig_atomic_t asked_to_stop = 0;
double last_signal = -1;  // s, of a clock without jumps

double now() {
  timespec time;
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The first signal is the child's business: it saves and says how to go on. The second one is ours.
void pass_on(int number, siginfo_t* info, void*) {
  const pid_t process = worker;
  if (process <= 0) return;
  const double time = now();
  const bool again = asked_to_stop != 0 && time - last_signal > apart;
  if (again) {
    ::kill(process, SIGKILL);
  } else if (info->si_code <= 0) {  // from a process; what a terminal sends, it sends to the child too
    ::kill(process, number);
  }
  asked_to_stop = 1;
  last_signal = time;
  ::alarm(patience);
}

void on_alarm(int, siginfo_t*, void*) {
  if (worker > 0) ::kill(worker, SIGKILL);
}

void handle(int number, void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action = {};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(number, &action, nullptr);
}

void copy(Path& to, const std::filesystem::path& from) {
  const std::string text = std::filesystem::absolute(from).string();
  if (text.size() < to.size()) std::memcpy(to.data(), text.c_str(), text.size() + 1);
}

/// All is said and written. What plugins have left for the end of the process, threads and handlers, is not run: it may
/// fall, or never end. Only what watches a process reports at its end.
[[noreturn]] void leave(int code) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(TUNICA_COVERAGE)
  std::exit(code);
#else
  std::fflush(nullptr);
  ::_exit(code);
#endif
}

[[noreturn]] void be_child(const std::function<int()>& work, pid_t parent) {
  for (const int number : passed_on) ::signal(number, SIG_DFL);
  ::signal(SIGALRM, SIG_DFL);
  ::signal(SIGXFSZ, SIG_IGN);          // a write beyond the limit then fails with words
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no process would resume the work or report its end
  if (::getppid() != parent) ::_exit(internal_error);
  plugins::casualties = &common->casualties;
  plugins::open_to_write = open_shared;
  set_shared(PROT_READ);
  const int code = work();
  open_shared();
  common->code = code;
  common->finished = the_end;
  leave(common->code);
}

/// A worker; blocks signals until it is known whom to pass them on to.
pid_t start(const std::function<int()>& work) {
  sigset_t blocked, before;
  ::sigemptyset(&blocked);
  for (const int number : passed_on) ::sigaddset(&blocked, number);
  ::sigprocmask(SIG_BLOCK, &blocked, &before);
  const pid_t parent = ::getpid(), process = ::fork();
  worker = process;
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  if (process == 0) be_child(work, parent);
  return process;
}

/// Ends as the child ended. A shell then sees the expected status after Ctrl-C or a closed pipe.
[[noreturn]] void end_by(int number) {
  ::signal(number, SIG_DFL);
  ::raise(number);
  ::_exit(128 + number);
}

/// A signal that shows a fault, or a kill from outside.
bool is_fault(int number) {
  constexpr std::array faults{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGKILL};
  return std::find(faults.begin(), faults.end(), number) != faults.end();
}

/// A plugin may have overwritten anything: the text is terminated, whatever it contains.
void end_texts() {
  for (plugins::Casualty& one : common->casualties.entries) one.plugin.back() = one.what.back() = one.end.back() = 0;
  for (Path* path : {&common->resumable, &common->disposable}) path->back() = 0;
  for (Path& path : common->unfinished) path.back() = 0;
}

/// Removes unfinished results of the child, which its successor starts again.
void remove_unfinished() {
  std::error_code left;
  if (common->disposable.front() != 0)
    for (const auto& entry : std::filesystem::directory_iterator(common->disposable.data(), left))
      std::filesystem::remove_all(entry.path(), left);
  for (Path& folder : common->unfinished) {
    if (folder.front() != 0 && ::unlink(folder.data()) != 0)
      ::rmdir(folder.data());  // fails, as it should, where something is inside
    folder.front() = 0;
  }
  common->disposable.front() = 0;
}

/// A successor would print the same output again.
bool has_answered() { return common->answered && !common->serves; }

/// A plugin that was evaluated no more, and whose thread ended the process again: it is made where the plugin is
/// loaded.
bool has_fallen_for_good(const plugins::Casualty& last) {
  return common->casualties.weight(last.plugin.data()) >= plugins::CasualtyList::most_of_one_plugin + last.weight;
}

/// The first few crashes are reported one by one; a plugin that continues to crash is reported once more.
void say_what_fell(const plugins::Casualty& casualty, bool goes_on) {
  using plugins::CasualtyList;
  constexpr unsigned told = 3;
  const std::string plugin = casualty.plugin.data();
  const std::string what = fmt::format("plugin '{}' {} in {}.", plugin, casualty.end.data(), place_of(casualty));
  if (!goes_on)
    return say_error(what +
                     " The work cannot be taken up from here; take the plugin out, or report this to its author");
  const auto all = std::span(common->casualties.entries).first(common->casualties.size());
  const auto times =
      std::count_if(all.begin(), all.end(), [&](const auto& one) { return plugin == one.plugin.data(); });
  if (common->casualties.weight(plugin) >= CasualtyList::most_of_one_plugin)
    return say_wrapped_warning(
        what + fmt::format(" It was time number {}: the plugin is not evaluated again, and the work goes "
                           "on without it.",
                           times));
  const bool of_call = casualty.what.data() != std::string_view(plugins::own_thread);
  if (times <= told)
    say_wrapped_warning(what + (of_call ? " This call counts as failed, and the work goes on."
                                        : " The work goes on from what was saved."));
}

/// Memory that no single call took.
void say_leak(bool goes_on) {
  if (!goes_on)
    return say_error(
        "memory came to its limit again and again while plugins were evaluated: one of them does not give back what it "
        "takes. What was saved is kept. Take the plugin out, or go on with --resume where the verb has it");
  if (common->casualties.leaks == 1)
    say_wrapped_warning(
        "memory came to its limit while plugins were evaluated; one of them may not give back what it takes. The work "
        "goes on in a new process, and nothing is lost.");
}

void say_unexplained(int status) {
  const std::string end =
      WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status)) : fmt::format("exit code {}", WEXITSTATUS(status));
  say_error(
      fmt::format("the work ended in the middle ({}), and nothing tells that it was in a plugin: somebody ended "
                  "it, memory ran out, or it is a fault of tunica. What was saved is kept; go on with --resume "
                  "where the verb has it",
                  end));
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

int supervise(const std::function<int()>& work) {
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return work();
  common = new (memory) Shared();
  for (const int number : passed_on) handle(number, pass_on);
  handle(SIGALRM, on_alarm);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  if (::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0, parking.data()) != 0) parking = {-1, -1};
  for (;; ++common->generation) {
    const unsigned before = common->casualties.size(), leaks = common->casualties.leaks;
    const pid_t process = start(work);
    if (process < 0) return work();
    const int status = wait_for(process);
    worker = 0;
    ::alarm(0);
    end_orphans();
    if (common->finished == the_end) return common->code;
    end_texts();
    const bool of_plugin = common->casualties.size() > before, leaked = common->casualties.leaks > leaks;
    if (WIFEXITED(status) && WEXITSTATUS(status) == interrupted && !of_plugin) return interrupted;
    if (WIFSIGNALED(status) && !is_fault(WTERMSIG(status))) {
      if (asked_to_stop == 0 && WTERMSIG(status) != SIGPIPE) say_unexplained(status);
      end_by(WTERMSIG(status));
    }
    remove_unfinished();
    if (asked_to_stop != 0) {
      say_error("ended in the middle of a calculation that did not stop; what was saved is kept");
      return interrupted;
    }
    if (!of_plugin && leaked) {
      const bool goes_on = !has_answered() && common->casualties.leaks <= plugins::CasualtyList::most_leaks;
      say_leak(goes_on);
      if (goes_on) continue;
      return internal_error;
    }
    if (!of_plugin) {
      say_unexplained(status);
      return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : internal_error;
    }
    const auto& entry = common->casualties.entries[before];
    const bool again = entry.what.data() == std::string_view(plugins::own_thread) && has_fallen_for_good(entry);
    const bool goes_on = !has_answered() && !again && common->casualties.size() < common->casualties.entries.size();
    say_what_fell(entry, goes_on);
    if (!goes_on) return internal_error;
  }
}

namespace supervised {

bool successor() { return common != nullptr && common->generation > 0; }

void resumable_in(const std::filesystem::path& folder) {
  if (common == nullptr) return;
  const SharedOpen open;
  copy(common->resumable, folder);
}

std::filesystem::path resumable_folder() { return common == nullptr ? "" : common->resumable.data(); }

void unfinished(const std::vector<std::filesystem::path>& made, const std::filesystem::path& results) {
  if (common == nullptr) return;
  const SharedOpen open;
  common->disposable.front() = 0;
  if (!results.empty()) copy(common->disposable, results);
  for (std::size_t i = 0; i < common->unfinished.size(); ++i) {
    common->unfinished[i].front() = 0;
    if (i < made.size() && !made[i].empty()) copy(common->unfinished[i], made[i]);
  }
}

void answered() {
  if (common == nullptr) return;
  const SharedOpen open;
  common->answered = true;
}

void serves() {
  if (common == nullptr) return;
  const SharedOpen open;
  common->serves = true;
}

namespace {

/// A message that carries one descriptor.
struct Parcel {
  char byte = 0;
  iovec content{&byte, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control = {};
  msghdr message{nullptr, 0, &content, 1, control.data(), control.size(), 0};
};

}  // namespace

void park(int descriptor) {
  if (common == nullptr) return;
  Parcel parcel;
  cmsghdr* header = CMSG_FIRSTHDR(&parcel.message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof descriptor);
  std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
  ::sendmsg(parking[0], &parcel.message, MSG_NOSIGNAL);
}

int parked() {
  if (common == nullptr) return -1;
  Parcel parcel;
  if (::recvmsg(parking[1], &parcel.message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC) <= 0) return -1;
  const cmsghdr* header = CMSG_FIRSTHDR(&parcel.message);
  if (header == nullptr || header->cmsg_type != SCM_RIGHTS) return -1;
  int descriptor = -1;
  std::memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
  return descriptor;
}

}  // namespace supervised
}  // namespace tunica::app
