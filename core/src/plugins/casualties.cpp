// SPDX-License-Identifier: Apache-2.0
#include "plugins/casualties.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace tunica::plugins {

namespace {

thread_local double time_lost = 0;

/// Signal handlers call it: no library but the language.
template <std::size_t N>
void copy(std::array<char, N>& to, const char* from) {
  std::size_t i = 0;
  for (; i + 1 < N && from[i] != 0; ++i) to[i] = from[i];
  to[i] = 0;
}

}  // namespace

std::string place_of(const Casualty& casualty) {
  const std::string what = casualty.what.data();
  return what == own_thread ? what : what + "()";
}

CallKey::CallKey(std::string_view plugin, std::string_view what) {
  for (const char c : plugin) add(static_cast<unsigned char>(c));
  for (const char c : what) add(static_cast<unsigned char>(c));
}

void CasualtyList::add(std::uint64_t key, const char* plugin, const char* what, const char* end, double seconds,
                       unsigned weight) {
  if (open_to_write != nullptr) open_to_write();
  const unsigned place = count.fetch_add(1);
  if (place >= entries.size()) {
    if (at_end_of_process != nullptr) at_end_of_process(nullptr);
    return;
  }
  Casualty& entry = entries[place];
  entry.key = key;
  entry.weight = seconds > 0 ? std::max(weight, weight_of_hang) : weight;
  entry.seconds = seconds;
  copy(entry.plugin, plugin);
  copy(entry.what, what);
  copy(entry.end, end);
  if (at_end_of_process != nullptr) at_end_of_process(&entry);
}

void CasualtyList::add_leak() {
  if (open_to_write != nullptr) open_to_write();
  leaks.fetch_add(1);
  if (at_end_of_process != nullptr) at_end_of_process(nullptr);
}

unsigned CasualtyList::size() const { return std::min(count.load(), static_cast<unsigned>(entries.size())); }

unsigned CasualtyList::weight(std::string_view plugin) const {
  unsigned found = 0;
  for (const Casualty& entry : std::span(entries).first(size()))
    if (plugin.substr(0, entry.plugin.size() - 1) == entry.plugin.data()) found += entry.weight;
  return found;
}

const Casualty* CasualtyList::find(std::uint64_t key) const {
  for (unsigned i = 0; i < size(); ++i)
    if (entries[i].key == key) return &entries[i];
  return nullptr;
}

bool is_stricken(const std::string& plugin) { return casualties != nullptr && casualties->weight(plugin) > 0; }

std::string refusal(const std::string& plugin, std::uint64_t key) {
  const Casualty* known = casualties == nullptr ? nullptr : casualties->find(key);
  if (known == nullptr) return {};
  time_lost += known->seconds;
  return fmt::format("plugin '{}' {} in {}; this call is not made again", plugin, known->end.data(), place_of(*known));
}

std::string refusal_of_evaluation(const std::string& plugin, std::uint64_t key) {
  std::string reason = refusal(plugin, key);
  if (!reason.empty() || casualties == nullptr || casualties->weight(plugin) < CasualtyList::most_of_one_plugin)
    return reason;
  return fmt::format("plugin '{}' ended the program too often and is not evaluated again; its author should see to it",
                     plugin);
}

double take_time_lost() { return std::exchange(time_lost, 0.0); }

}  // namespace tunica::plugins
