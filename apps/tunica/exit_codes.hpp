// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tunica::app {

/// The exit codes of the process; scripts rely on them.
enum ExitCode : int {
  done = 0,
  not_converged =
      1,  ///< ran, but a run has no fit: did not converge, broke its constraints, mostly failed or was given up
  invalid_input = 2,
  plugin_refused = 3,
  internal_error = 4,
  interrupted = 130  ///< saved; go on with --resume
};

}  // namespace tunica::app
