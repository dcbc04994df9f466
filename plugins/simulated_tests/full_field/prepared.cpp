// SPDX-License-Identifier: Apache-2.0
#include "prepared.hpp"

#include <map>
#include <mutex>
#include <span>
#include <string>

#include "reference.hpp"
#include "settings.hpp"

namespace tunica::field {
namespace {

void append(std::string& key, const std::string& text) { key += text + '\n'; }

void append(std::string& key, std::span<const double> values) {
  key.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());  // doubles as bytes, NaN included
  key += '\n';
}

/// All that Prepared is made from.
std::string key_of(const TestSetup& setup) {
  std::string key = setup.folder + '\n';
  for (const char* option : {"mesh", "shape", "boundary", "unseen_sides", "state"})
    append(key, setup.options.text(option));
  append(key, std::to_string(setup.options.count("smoothing")));
  for (const auto& column : setup.rows.abscissae) {
    append(key, column.observable);
    append(key, column.values);
  }
  for (const std::string& channel : setup.rows.channels) append(key, channel);
  for (const auto& values : setup.measured) append(key, values);
  return key;
}

}  // namespace

Prepared::Prepared(const TestSetup& setup)
    : edges(edges_of(setup.options)),
      smoothing(setup.options.count("smoothing")),
      rows(setup, edges),
      mesh(rows, edges, smoothing, mesh_of(setup)) {
  mesh.smooth(reference_fields(mesh, setup.options.text("state") == "plane_strain"));
  if (setup.options.text("unseen_sides") == "refuse") mesh.refuse_unseen_sides();
  mesh.refuse_forces(edges);
}

std::shared_ptr<const Prepared> prepared(const TestSetup& setup) {
  // Different fields are prepared in parallel, and each field only once.
  struct Slot {
    std::mutex mutex;
    std::weak_ptr<const Prepared> made;
  };
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<Slot>> known;
  std::shared_ptr<Slot> slot;
  {
    const std::scoped_lock lock(mutex);
    std::erase_if(known, [](const auto& one) { return one.second.use_count() == 1 && one.second->made.expired(); });
    auto& place = known[key_of(setup)];
    if (!place) place = std::make_shared<Slot>();
    slot = place;
  }
  const std::scoped_lock lock(slot->mutex);
  if (auto found = slot->made.lock()) return found;
  auto made = std::make_shared<const Prepared>(setup);
  slot->made = made;
  return made;
}

}  // namespace tunica::field
