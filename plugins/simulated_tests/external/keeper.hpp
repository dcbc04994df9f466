// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <sys/types.h>

namespace tunica::external {

/// The messages that the keeper of a program sends through its pipe, in order.
struct Message {
  enum class Kind {
    group,        ///< the program's process group
    not_made,     ///< no process for it; errno
    not_ready,    ///< its folder or the file of its output cannot be used; errno
    not_run,      ///< the file cannot be executed; errno
    not_watched,  ///< the system cannot tell when a process ends; errno
    ended         ///< what waitpid says
  };
  Kind kind = Kind::ended;
  int value = 0;
};

/// The data of a keeper, made before the fork because nothing may be allocated after it.
struct Kept {
  const char* folder;         ///< in which the program runs
  const char* output;         ///< takes what it prints
  char* const* words;         ///< the program and its arguments, ended by a null pointer
  char* const* variables;     ///< its environment, ended by a null pointer
  char* const* after_death;   ///< a command that tidies up where the parent dies; null = none
  std::size_t address_space;  ///< its limit in bytes; 0 = none
  std::size_t file_size;      ///< of each file that it writes, in bytes; 0 = none
  pid_t parent;               ///< whose death ends the program
  int pipe;                   ///< takes the messages
};

/// The child between this process and the program, behind fork: it starts the program in a group of its own, and kills
/// the group when the program has ended or the parent has died, whatever it died of. Calls only what is safe there.
[[noreturn]] void keep(const Kept& kept);

}  // namespace tunica::external
