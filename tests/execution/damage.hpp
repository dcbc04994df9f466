// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <cstdint>
#include <string>

#include <sys/resource.h>

#include "execution/checksum.hpp"

/// What can happen to the files of a run.
namespace tunica::trial {

/// A row of evaluations.csv from its cells: with the checksum and the line end.
inline std::string checked(const std::string& cells) { return cells + ',' + execution::checksum(cells) + '\n'; }

/// The same text with another character in one place; a digit becomes another digit.
inline std::string changed(std::string text, std::size_t place) {
  char& one = text[place];
  one = one >= '0' && one <= '9' ? static_cast<char>('0' + (one - '0' + 1) % 10) : static_cast<char>(one ^ 1);
  return text;
}

/// While it lives, no file of this process grows beyond so many bytes: what a full disk looks like to a program.
class NoLargerFile {
 public:
  explicit NoLargerFile(std::uintmax_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~NoLargerFile() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, old_handler_);
  }
  NoLargerFile(const NoLargerFile&) = delete;
  NoLargerFile& operator=(const NoLargerFile&) = delete;

 private:
  rlimit before_{};
  void (*old_handler_)(int) = SIG_DFL;
};

}  // namespace tunica::trial
