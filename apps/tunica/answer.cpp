// SPDX-License-Identifier: Apache-2.0
#include "answer.hpp"

#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "execution/files.hpp"
#include "supervisor.hpp"
#include "text/escaped.hpp"

namespace tunica::app {

namespace {

std::FILE* destination = stdout;
int problem = 0;  ///< errno of the first write that failed

}  // namespace

void keep_stdout() {
  if (destination != stdout) return;
  std::fflush(stdout);
  const int own = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (own < 0) return;  // it was closed when the program started
  std::FILE* opened = ::fdopen(own, "w");
  if (opened == nullptr || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return;
  destination = opened;
}

int answer_descriptor() { return ::fileno(destination); }

void write_answer(const std::string& words) {
  // Colours are our own; names of folders are others', and need not be text.
  const std::string plain = text::is_utf8(words) ? words : text::escaped(words, "\n\t\033");
  errno = 0;
  if (std::fwrite(plain.data(), 1, plain.size(), destination) < plain.size() && problem == 0) problem = errno;
}

void flush_answer() {
  if (std::fflush(destination) != 0 && problem == 0) problem = errno;
  if (problem != 0) throw execution::WriteFailure("stdout", problem);
  supervised::answered();
}

void print_json(const nlohmann::ordered_json& document) {
  answer("{}\n", text::plain_json(document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

}  // namespace tunica::app
