// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include <unistd.h>

namespace tunica::conformance {

/// Takes what the process writes to stdout and stderr, until it is asked for it.
class CapturedOutput {
 public:
  CapturedOutput() : file_(std::tmpfile()) {
    std::fflush(nullptr);
    if (file_ == nullptr) return;
    out_ = ::dup(STDOUT_FILENO);
    err_ = ::dup(STDERR_FILENO);
    ::dup2(::fileno(file_), STDOUT_FILENO);
    ::dup2(::fileno(file_), STDERR_FILENO);
  }
  CapturedOutput(const CapturedOutput&) = delete;
  CapturedOutput& operator=(const CapturedOutput&) = delete;
  ~CapturedOutput() {
    give_back();
    if (file_ != nullptr) std::fclose(file_);
  }
  std::string text() {
    give_back();
    std::string all;
    if (file_ == nullptr) return all;
    std::rewind(file_);
    for (int c = std::fgetc(file_); c != EOF; c = std::fgetc(file_)) all.push_back(static_cast<char>(c));
    return all;
  }

 private:
  void give_back() {
    if (out_ < 0) return;
    std::fflush(nullptr);
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(err_, STDERR_FILENO);
    ::close(out_);
    ::close(err_);
    out_ = err_ = -1;
  }
  std::FILE* file_;
  int out_ = -1, err_ = -1;
};

}  // namespace tunica::conformance
