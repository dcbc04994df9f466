// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tunica::app {

/// Ends what plugins have forked and left behind: a subreaper becomes the parent of all of it. What tidies up after its
/// work, as the keepers of solvers do, has a moment for it.
void end_orphans();

}  // namespace tunica::app
