// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tunica::diagnosis {

/// Whether a mechanism is an error of the record with one amplitude. Such errors are weighed in the group `file`, with
/// its prior. They are no candidates beside the causes of the material and of the rig, unless somebody asks for them by
/// name: most of them can do what a stiffer material does.
bool errs_in_the_record(std::string_view mechanism);

}  // namespace tunica::diagnosis
