// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <cstddef>
#include <memory>

namespace tunica::plugins {

/// While it lives, handlers of the calling thread that ask for it (SA_ONSTACK) run on a stack of their own. It is taken
/// back before its memory goes: a signal may come until the very end of a thread.
class SignalStack {
 public:
  static constexpr std::size_t size = 64 * 1024;  ///< bytes

  SignalStack() {
    stack_t stack = {};
    stack.ss_sp = memory_.get();
    stack.ss_size = size;
    ::sigaltstack(&stack, nullptr);
  }
  ~SignalStack() {
    stack_t none = {};
    none.ss_flags = SS_DISABLE;
    ::sigaltstack(&none, nullptr);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  std::unique_ptr<std::byte[]> memory_ = std::make_unique<std::byte[]>(size);
};

}  // namespace tunica::plugins
