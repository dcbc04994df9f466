// SPDX-License-Identifier: Apache-2.0
#include "cache.hpp"

#include <array>
#include <cstdint>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nettle/sha2.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

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
  std::ifstream stream(file(key));
  if (!stream) return std::nullopt;
  const auto document = nlohmann::json::parse(stream, nullptr, false);
  try {
    auto numbers = document.get<Numbers>();
    if (numbers.size() != observables_) return std::nullopt;
    return kept_.emplace(key, std::move(numbers)).first->second;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // a file that is no result is written anew
  }
}

void Cache::keep(const std::string& key, const Numbers& numbers) {
  const std::lock_guard lock(mutex_);
  kept_.insert_or_assign(key, numbers);
  if (folder_.empty()) return;
  // Under another name first, so that no reader finds half a file. What cannot be written is only computed again.
  const std::filesystem::path partial = folder_ / fmt::format("{}.{}.part", key, getpid());
  std::ofstream(partial) << nlohmann::json(numbers).dump();
  std::error_code error;
  std::filesystem::rename(partial, file(key), error);
}

}  // namespace tunica::external
