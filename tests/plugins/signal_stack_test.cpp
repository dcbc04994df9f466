// SPDX-License-Identifier: Apache-2.0
#include "plugins/signal_stack.hpp"

#include <cstdint>

#include <gtest/gtest.h>

namespace tunica::plugins {
namespace {

std::uintptr_t handler_ran_at = 0;

TEST(SignalStack, IsWhereHandlersRunAndIsTakenBackBeforeItsMemoryGoes) {
  stack_t before = {}, while_it_lives = {}, after = {};
  ASSERT_EQ(::sigaltstack(nullptr, &before), 0);
  struct sigaction action = {}, usual = {};
  action.sa_flags = SA_ONSTACK;
  action.sa_handler = [](int) {
    const volatile char here = 0;
    handler_ran_at = reinterpret_cast<std::uintptr_t>(&here);
  };
  ASSERT_EQ(::sigaction(SIGUSR1, &action, &usual), 0);
  {
    const SignalStack stack;
    ::sigaltstack(nullptr, &while_it_lives);
    std::raise(SIGUSR1);
  }
  ::sigaltstack(nullptr, &after);
  ::sigaction(SIGUSR1, &usual, nullptr);
  ::sigaltstack(&before, nullptr);

  EXPECT_EQ(while_it_lives.ss_size, SignalStack::size);
  EXPECT_EQ(while_it_lives.ss_flags, 0);
  const auto first = reinterpret_cast<std::uintptr_t>(while_it_lives.ss_sp);
#ifndef __SANITIZE_ADDRESS__  // which has variables elsewhere
  EXPECT_GE(handler_ran_at, first);
  EXPECT_LT(handler_ran_at, first + SignalStack::size);
#endif
  EXPECT_NE(first, 0u);
  EXPECT_EQ(after.ss_flags, SS_DISABLE);
}

}  // namespace
}  // namespace tunica::plugins
