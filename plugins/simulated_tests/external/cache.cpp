// SPDX-License-Identifier: Apache-2.0
#include "cache.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <exception>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nettle/sha2.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "results.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::external {

std::string digest(std::string_view text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes{};
  sha256_digest(&context, bytes.size(), bytes.data());
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

namespace {

/// False where it cannot be written. What stands there under the name, a link or what a killed process has left, is
/// taken away; nothing is written through it.
bool write_new(const std::filesystem::path& file, std::string_view text) {
  ::unlink(file.c_str());
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) return false;
  bool whole = true;
  while (whole && !text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    whole = written > 0 || (written < 0 && errno == EINTR);
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  ::close(descriptor);
  if (!whole) ::unlink(file.c_str());
  return whole;
}

}  // namespace

Cache::Cache(std::filesystem::path folder, std::size_t observables)
    : folder_(std::move(folder)), observables_(observables) {
  if (folder_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw InputError(fmt::format("the folder of \"cache\", {}, cannot be made: {}; name another one", folder_.string(),
                                 error.message()));
}

std::optional<Numbers> Cache::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
  if (folder_.empty()) return std::nullopt;
  try {
    const auto document = detail::parse_json(text_below(file(key), largest_file), false);
    const auto& kept = document.at("numbers");
    if (document.at("sha256") != digest(key + kept.dump())) return std::nullopt;
    auto numbers = kept.get<Numbers>();
    if (numbers.size() != observables_) return std::nullopt;
    return kept_.emplace(key, std::move(numbers)).first->second;
  } catch (const std::exception&) {
    return std::nullopt;  // what is no result, is damaged or cannot be read (a folder, a faulty disk) is made anew
  }
}

void Cache::keep(const std::string& key, const Numbers& numbers) {
  const std::lock_guard lock(mutex_);
  kept_.insert_or_assign(key, numbers);
  if (folder_.empty()) return;
  // It is first written under another name, so no reader finds an incomplete file. If writing fails, the result is only
  // computed again.
  const std::filesystem::path partial = folder_ / fmt::format("{}.{}.part", key, getpid());
  const nlohmann::json list(numbers);
  std::error_code error;
  if (write_new(partial, nlohmann::json{{"numbers", list}, {"sha256", digest(key + list.dump())}}.dump()))
    std::filesystem::rename(partial, file(key), error);
}

}  // namespace tunica::external
