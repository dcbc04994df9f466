// SPDX-License-Identifier: Apache-2.0
// _exit() and _Exit() of plugins. The program's symbols stand before those of the C library for every library that it
// loads, so a plugin that ends the process by them is told like one that calls exit(). exit() itself does not come
// here.
#include <sys/syscall.h>
#include <unistd.h>

#include "plugins/last_words.hpp"

extern "C" {

// Made by the linker: where the code of this program begins and ends.
extern const char __executable_start;  // NOLINT(bugprone-reserved-identifier)
extern const char etext;

namespace {

[[noreturn]] void leave(int code, const void* caller) {
  const bool ours =
      caller >= static_cast<const void*>(&__executable_start) && caller < static_cast<const void*>(&etext);
  if (!ours && tunica::plugins::enter_exit_in_plugin("called _exit()")) code = tunica::plugins::fell;
  for (;;) ::syscall(SYS_exit_group, code);
}

}  // namespace

#pragma GCC visibility push(default)
void _exit(int code) { leave(code, __builtin_return_address(0)); }
void _Exit(int code) noexcept { leave(code, __builtin_return_address(0)); }
#pragma GCC visibility pop

}  // extern "C"
