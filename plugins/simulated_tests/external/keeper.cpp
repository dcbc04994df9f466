// SPDX-License-Identifier: Apache-2.0
// POSIX calls: Boost.Process 1.74 waits for a child with a time limit by blocking SIGCHLD of the calling thread, which
// several waiting threads cannot share; and it leaves the program's own children running where this process dies.
#include "keeper.hpp"

#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tunica::external {
namespace {

void tell(int pipe, Message::Kind kind, int value) {
  const Message message{kind, value};
  [[maybe_unused]] const auto written = write(pipe, &message, sizeof message);  // the reader is gone: nobody to tell
}

/// A new program expects the signal state that a shell gives it: no signal blocked, none ignored.
void restore_signals() {
  struct sigaction standard = {};
  standard.sa_handler = SIG_DFL;
  for (int number = 1; number < NSIG; ++number) sigaction(number, &standard, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void become(const Kept& kept) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  restore_signals();
  if (kept.address_space > 0) {
    const rlimit limit{kept.address_space, kept.address_space};
    setrlimit(RLIMIT_AS, &limit);
  }
  if (kept.file_size > 0) {
    const rlimit limit{kept.file_size, kept.file_size};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  const int nothing = open("/dev/null", O_RDONLY);
  const int printed = open(kept.output, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (nothing < 0 || printed < 0 || chdir(kept.folder) != 0) {
    tell(kept.pipe, Message::Kind::not_ready, errno);
    _exit(126);
  }
  dup2(nothing, STDIN_FILENO);
  dup2(printed, STDOUT_FILENO);
  dup2(printed, STDERR_FILENO);
  execve(kept.words[0], kept.words, kept.variables);
  tell(kept.pipe, Message::Kind::not_run, errno);
  _exit(126);
}

/// A descriptor that can be read when the process has ended. By its number: the header of glibc 2.36 declares
/// pidfd_open without extern "C".
int descriptor_of(pid_t process) { return static_cast<int>(syscall(SYS_pidfd_open, process, 0)); }

}  // namespace

void keep(const Kept& kept) {
  setpgid(0, 0);  // Ctrl-C of the terminal is for the parent, which says what becomes of the program
  const int parent = descriptor_of(kept.parent);
  const int problem = errno;
  if (getppid() != kept.parent) _exit(127);
  const pid_t program = parent < 0 ? -1 : fork();
  if (program == 0) become(kept);
  if (program < 0) {
    tell(kept.pipe, parent < 0 ? Message::Kind::not_watched : Message::Kind::not_made, parent < 0 ? problem : errno);
    _exit(127);
  }
  setpgid(program, program);  // both sides do it; the first call counts
  const int running = descriptor_of(program);
  if (running < 0) {
    tell(kept.pipe, Message::Kind::not_watched, errno);
    kill(-program, SIGKILL);
    _exit(127);
  }
  tell(kept.pipe, Message::Kind::group, program);
  pollfd watched[] = {{running, POLLIN, 0}, {parent, POLLIN, 0}};
  while (poll(watched, 2, -1) < 0 && errno == EINTR) {
  }
  kill(-program, SIGKILL);  // before waiting for it: until then its number cannot be reused
  int status = 0;
  while (waitpid(program, &status, 0) < 0 && errno == EINTR) {
  }
  tell(kept.pipe, Message::Kind::ended, status);
  if ((watched[1].revents & POLLIN) != 0 && kept.after_death != nullptr)
    execve(kept.after_death[0], kept.after_death, environ);
  _exit(0);
}

}  // namespace tunica::external
