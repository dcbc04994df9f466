// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include <nlohmann/json_fwd.hpp>

namespace tunica::experiment {

using Json = nlohmann::ordered_json;  // keeps the order of the file

/// A JSON text (comments tolerated) as values, with the place of every value in the text. nlohmann_json makes the
/// values but forgets where they stood, so a scanner walks the text beside it: it also finds duplicate keys, which
/// the parser would silently merge, and words syntax errors for people.
class JsonDocument {
 public:
  struct Place {
    std::size_t line, column;  ///< from 1; columns count characters, not bytes
  };

  /// Throws InputError: line, column, what was found and what was expected.
  JsonDocument(std::filesystem::path file, std::string text);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const Json& root() const { return *root_; }
  /// Of a value in an array, or of the key of a member; where nothing stands, of the nearest enclosing value.
  [[nodiscard]] Place place(std::string_view pointer) const;

  /// Bytes [begin, end) of the text that a value takes.
  struct Extent {
    std::size_t begin, end;
  };
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::optional<Extent> extent(std::string_view pointer) const;

 private:
  friend class Scanner;
  struct Where {
    std::size_t shown;  ///< byte that people look for: of the key of a member, else of the value
    Extent value;
  };
  std::filesystem::path file_;
  std::string text_;
  std::shared_ptr<const Json> root_;
  std::unordered_map<std::string, Where> where_;  ///< by JSON pointer
};

/// One more step of a JSON pointer, escaped as RFC 6901 asks.
std::string child_pointer(std::string_view pointer, std::string_view key);

}  // namespace tunica::experiment
