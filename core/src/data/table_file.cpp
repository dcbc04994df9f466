// SPDX-License-Identifier: Apache-2.0
#include "data/table_file.hpp"

#include <ctime>
#include <list>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include <sys/stat.h>

#include "data/sha256.hpp"

namespace tunica::data {
namespace {

constexpr std::size_t most_bytes = std::size_t{16} << 20;  ///< of all files that are kept

/// What changes when a file does.
struct Identity {
  dev_t device = 0;
  ino_t node = 0;
  off_t size = 0;
  timespec modified{}, changed{};

  [[nodiscard]] auto key() const {
    return std::tuple(device, node, size, modified.tv_sec, modified.tv_nsec, changed.tv_sec, changed.tv_nsec);
  }
};

/// None where the times of the file do not tell one state of it from the next.
std::optional<Identity> identity_of(const std::filesystem::path& file) {
  constexpr time_t settled = 2;  // s
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  if (std::time(nullptr) - status.st_mtim.tv_sec <= settled) return std::nullopt;
  return Identity{status.st_dev, status.st_ino, status.st_size, status.st_mtim, status.st_ctim};
}

auto key_of(const TableLayout& layout) {
  return std::tie(layout.skip_lines, layout.delimiter, layout.decimal, layout.units, layout.by_position,
                  layout.row_names);
}

struct Kept {
  std::filesystem::path file;
  Identity identity;
  TableLayout layout;
  std::shared_ptr<const TableFile> table;
};

/// Files that were read, the youngest first.
class Shelf {
 public:
  std::shared_ptr<const TableFile> find(const std::filesystem::path& file, const Identity& identity,
                                        const TableLayout& layout) {
    const std::lock_guard lock(mutex_);
    for (const Kept& one : kept_)
      if (one.file == file && one.identity.key() == identity.key() && key_of(one.layout) == key_of(layout))
        return one.table;
    return nullptr;
  }
  void keep(Kept one) {
    const std::lock_guard lock(mutex_);
    bytes_ += static_cast<std::size_t>(one.identity.size);
    kept_.push_front(std::move(one));
    while (bytes_ > most_bytes) {
      bytes_ -= static_cast<std::size_t>(kept_.back().identity.size);
      kept_.pop_back();
    }
  }

 private:
  std::mutex mutex_;
  std::list<Kept> kept_;
  std::size_t bytes_ = 0;
};

}  // namespace

std::shared_ptr<const TableFile> table_file(const std::filesystem::path& file, const TableLayout& layout) {
  static Shelf shelf;
  const auto identity = identity_of(file);
  if (identity)
    if (auto known = shelf.find(file, *identity, layout)) return known;
  const std::string bytes = read_bytes(file);
  auto table = std::make_shared<const TableFile>(TableFile{parse_csv(file, bytes, layout), sha256(bytes)});
  if (identity) shelf.keep({file, *identity, layout, table});
  return table;
}

}  // namespace tunica::data
