// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "execution/folder.hpp"

namespace tunica::trial {

/// Whether a process has ended, or does within ten seconds: who is killed is reaped some time later.
inline bool is_gone(pid_t process) {
  for (int k = 0; k < 500; ++k) {
    if (kill(process, 0) != 0) return true;
    if (text_of("/proc/" + std::to_string(process) + "/stat").find(") Z") != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

}  // namespace tunica::trial
