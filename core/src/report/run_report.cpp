// SPDX-License-Identifier: Apache-2.0
#include "report/sections.hpp"

namespace tunica::report {

void add_run(Page& page, const Folder& folder) {
  const Order order(folder.result());
  page.section("Summary");
  add_warnings(page, folder);
  add_summary(page, folder, order);
  add_ranking(page, folder, order);
  add_fits(page, folder, order);
  add_parameters(page, folder, order);
  add_stability(page, folder, order);
  add_walls(page, folder);
  add_searches(page, folder, order);
  add_provenance(page, folder);
}

}  // namespace tunica::report
