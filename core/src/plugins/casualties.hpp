// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

/// Calls into plugins that ended the process: a crash, an exit, a call that never came back. The process that takes
/// the work up again finds them here, and does not make them again.
namespace tunica::plugins {

/// Says which call it was: the plugin, what it was asked for and every bit of its parameters. FNV-1a, in steps of 64
/// bits.
class CallKey {
 public:
  CallKey(std::string_view plugin, std::string_view what);
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3; }
  void add(std::span<const double> values) {
    add(values.size());
    for (const double& value : values) {
      std::uint64_t word;
      std::memcpy(&word, &value, sizeof word);
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// One such call. Texts end with 0; longer ones are cut.
struct Casualty {
  std::uint64_t key = 0;
  unsigned weight = 1;               ///< see CasualtyList::most_of_one_plugin
  double seconds = 0;                ///< that it took before it was given up
  std::array<char, 96> plugin = {};  ///< as Catalogue::Entry names it: "gho 0.1.0"
  std::array<char, 32> what = {};    ///< "evaluate", "predict", …
  std::array<char, 256> end = {};    ///< "ended the program: segmentation fault (SIGSEGV)"
};

/// `what` of a casualty that came of no call.
constexpr char own_thread[] = "a thread of its own";
/// "evaluate()", or `own_thread`.
std::string place_of(const Casualty& casualty);

/// The list, in memory that a process shares with its successors. Signal handlers write to it, so nothing in it
/// allocates or locks.
struct CasualtyList {
  /// A plugin that ended this many processes is not evaluated again; calls that hang or take the memory cost time, and
  /// count more. So do threads of its own, for no call can be left out.
  static constexpr unsigned most_of_one_plugin = 20, weight_of_hang = 2, weight_of_memory = 3, weight_of_thread = 5;

  /// Processes that ended for lack of memory without a single culprit; more than this are not an accident.
  static constexpr unsigned most_leaks = 20;

  std::atomic<unsigned> count = 0, leaks = 0;
  std::array<Casualty, 64> entries = {};

  void add(std::uint64_t key, const char* plugin, const char* what, const char* end, double seconds,
           unsigned weight = 1);
  void add_leak();
  [[nodiscard]] unsigned size() const;
  /// How many of a plugin, hangs weighted.
  [[nodiscard]] unsigned weight(std::string_view plugin) const;
  [[nodiscard]] const Casualty* find(std::uint64_t key) const;
};

/// Called when an entry was made, or null for a leak: the process ends at once. In signal handlers: nothing that
/// allocates or locks.
inline void (*at_end_of_process)(const Casualty* entry) = nullptr;

/// Called before the list is written to: its owner may hold it closed, so that no plugin writes into it. Once open it
/// stays open, for the process ends. In signal handlers, too.
inline void (*open_to_write)() = nullptr;

/// The list of this process, or null if no other process will resume its work.
inline CasualtyList* casualties = nullptr;

/// Whether a call of this plugin has ended a process.
bool is_stricken(const std::string& plugin);
/// Why the call must not be made: "plugin 'x' ended the program …". Empty: it may be. For stricken plugins only.
std::string refusal(const std::string& plugin, std::uint64_t key);
/// The same for an evaluation, which a plugin that has failed too often is not asked for at all.
std::string refusal_of_evaluation(const std::string& plugin, std::uint64_t key);
/// What refused calls of this thread had cost, in s, since it was asked last.
double take_time_lost();

}  // namespace tunica::plugins
