// SPDX-License-Identifier: Apache-2.0
#include "experiment/json_document.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/limits.hpp"
#include "experiment/placed_error.hpp"
#include "experiment/suggest.hpp"
#include "tunica/error.hpp"

namespace tunica::experiment {
namespace {

constexpr std::size_t deepest = 64;  // levels of nesting; the experiment file needs eight

JsonDocument::Place place_of(std::string_view text, std::size_t offset) {
  JsonDocument::Place place{1, 1};
  for (const char c : text.substr(0, offset)) {
    if (c == '\n') {
      ++place.line;
      place.column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0u) != 0x80u)
      ++place.column;
  }
  return place;
}

}  // namespace

/// Walks the structure of a JSON text and notes where each value stands. Strings and numbers are skipped over; whether
/// they are well formed is for the parser to say.
class Scanner {
 public:
  Scanner(const std::filesystem::path& file, std::string_view text,
          std::unordered_map<std::string, JsonDocument::Where>& where)
      : file_(file), text_(text), where_(where) {}

  void scan() {
    skip_space();
    if (at_ >= text_.size()) fail(at_, "the file is empty", "Expected an object, { … }.");
    value("", 0);
    skip_space();
    if (at_ < text_.size())
      fail(at_, fmt::format("found {} after the end of the JSON text", found()), "Is there a brace too many above?");
  }

 private:
  [[noreturn]] void fail(std::size_t offset, std::string_view what, std::string_view help,
                         std::string_view pointer = {}) const {
    const auto [line, column] = place_of(text_, offset);
    throw PlacedError(fmt::format("{}: {} ({}{}line {}, column {}).{}{}", file_.string(), what, excerpt(pointer, 300),
                                  pointer.empty() ? "" : ", ", line, column, help.empty() ? "" : " ", help),
                      line, column);
  }

  [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  [[nodiscard]] bool at(std::string_view token) const { return text_.substr(at_).starts_with(token); }

  [[nodiscard]] std::string found() const {
    if (at_ >= text_.size()) return "the end of the file";
    std::size_t end = at_;
    while (end < text_.size() && end < at_ + 20 &&
           std::string_view(" \t\r\n,:{}[]").find(text_[end]) == std::string_view::npos)
      ++end;
    return fmt::format("'{}'", excerpt(text_.substr(at_, std::max<std::size_t>(end - at_, 1))));
  }

  void skip_space() {
    while (at_ < text_.size()) {
      if (std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
        ++at_;
      else if (at("//"))
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      else if (at("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) fail(at_, "a comment opens and never closes", "Close it with */.");
        at_ = end + 2;
      } else
        return;
    }
  }

  void value(const std::string& pointer, std::size_t depth) {
    where_.emplace(pointer, JsonDocument::Where{at_, {at_, at_}});
    if (depth > deepest)
      fail(at_, fmt::format("more than {} levels of nesting", deepest), "Is a bracket missing above?");
    if (here() == '{')
      object(pointer, depth);
    else if (here() == '[')
      array(pointer, depth);
    else if (here() == '"')
      string();
    else
      literal();
    where_.at(pointer).value.end = at_;
  }

  void object(const std::string& pointer, std::size_t depth) {
    const std::size_t opened = at_++;
    skip_space();
    if (here() == '}') return void(++at_);
    for (;;) {
      const std::size_t key_at = at_;
      if (here() != '"')
        fail(at_, fmt::format("found {} where a key in double quotes is expected", found()),
             here() == '}'         ? "Remove the comma before it."
             : here() == '\''      ? "JSON has double quotes only."
             : at_ >= text_.size() ? unclosed(opened, '}')
                                   : "Keys look like \"name\": …");
      const std::string key = string();
      if (key.size() > limits::key_bytes)
        fail(key_at,
             fmt::format("the key '{}' has {} bytes, and at most {} are allowed", excerpt(key), key.size(),
                         limits::key_bytes),
             "Shorten it.");
      const std::string child = child_pointer(pointer, key);
      if (const auto first = where_.find(child); first != where_.end())
        fail(key_at, fmt::format("the key '{}' appears twice in the same object", excerpt(key)),
             fmt::format("It was given before in line {}; names must differ. Remove or rename one.",
                         place_of(text_, first->second.shown).line),
             child);
      skip_space();
      if (here() != ':')
        fail(at_, fmt::format("found {} where ':' is expected after the key '{}'", found(), excerpt(key)), {});
      ++at_;
      skip_space();
      value(child, depth + 1);
      where_.at(child).shown = key_at;  // people look for the key
      skip_space();
      if (here() == '}') return void(++at_);
      if (here() != ',')
        fail(at_, fmt::format("found {} where ',' or '}}' is expected after the value of '{}'", found(), excerpt(key)),
             at_ >= text_.size() ? unclosed(opened, '}') : "Is a comma missing before it?");
      ++at_;
      skip_space();
    }
  }

  void array(const std::string& pointer, std::size_t depth) {
    const std::size_t opened = at_++;
    skip_space();
    if (here() == ']') return void(++at_);
    for (std::size_t i = 0;; ++i) {
      if (here() == ']') fail(at_, "found ']' where a value is expected", "Remove the comma before it.");
      value(fmt::format("{}/{}", pointer, i), depth + 1);
      skip_space();
      if (here() == ']') return void(++at_);
      if (here() != ',')
        fail(at_, fmt::format("found {} where ',' or ']' is expected", found()),
             at_ >= text_.size() ? unclosed(opened, ']') : "Is a comma missing before it?");
      ++at_;
      skip_space();
    }
  }

  [[nodiscard]] std::string unclosed(std::size_t opened, char bracket) const {
    return fmt::format("The '{}' of line {} is not closed: a '{}' is missing.", text_[opened],
                       place_of(text_, opened).line, bracket);
  }

  // The decoded text of a string.
  std::string string() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') at_ += text_[at_] == '\\' ? 2 : 1;
    if (at_ >= text_.size() || text_[at_] != '"')
      fail(begin, "a text opens with \" and does not close in its line", "Close it with \".");
    ++at_;
    const std::string_view raw = text_.substr(begin, at_ - begin);
    if (raw.find('\\') == std::string_view::npos) return std::string(raw.substr(1, raw.size() - 2));
    const Json decoded = Json::parse(raw, nullptr, false);
    if (decoded.is_discarded())
      fail(begin, fmt::format("the text {} has an escape that JSON does not know", excerpt(raw)),
           "Write a backslash as \\\\.");
    auto text = decoded.get<std::string>();
    if (text.find('\0') != std::string::npos)
      fail(begin, fmt::format("the text {} has a NUL character, where names and paths would end", excerpt(raw)),
           "Take it out.");
    return text;
  }

  void literal() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                  std::string_view("+-._").find(text_[at_]) != std::string_view::npos))
      ++at_;
    const std::string_view token = text_.substr(begin, at_ - begin);
    if (token == "true" || token == "false" || token == "null") return;
    if (!token.empty() && (token[0] == '-' || (token[0] >= '0' && token[0] <= '9'))) {
      if (Json::accept(token)) return;
      fail(begin, fmt::format("'{}' is not a number as JSON writes it, or too large for one", excerpt(token)),
           "Put quantities with units in double quotes: \"3.71 mm\".");
    }
    at_ = begin;
    fail(begin, fmt::format("found {} where a value is expected", found()),
         here() == '\''                   ? "JSON has double quotes only."
         : here() == ',' || here() == '}' ? "Is a value missing, or a comma too many?"
         : at_ >= text_.size()            ? "The file ends too early."
                                          : "Put text in double quotes.");
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::unordered_map<std::string, JsonDocument::Where>& where_;
  std::size_t at_ = 0;
};

JsonDocument::JsonDocument(std::filesystem::path file, std::string text)
    : file_(std::move(file)), text_(std::move(text)) {
  if (text_.size() > limits::file_bytes)
    throw InputError(fmt::format("{}: the JSON text has {} MiB; expected at most {}. Put numbers into data files.",
                                 file_.string(), (text_.size() >> 20) + 1, limits::file_bytes >> 20));
  std::error_code unknown;
  if (!text::is_utf8(std::filesystem::absolute(file_, unknown).string()))
    throw InputError(
        fmt::format("{}: the name of the file, or of a folder above it, is not UTF-8, so that no result could name it. "
                    "Rename it, or move the file.",
                    file_.string()));
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  Scanner(file_, text_, where_).scan();
  try {
    root_ = std::make_shared<const Json>(Json::parse(text_, nullptr, true, true));
  } catch (const nlohmann::json::exception& error) {
    const auto* parse_error = dynamic_cast<const nlohmann::json::parse_error*>(&error);
    const auto [line, column] =
        place_of(text_, parse_error != nullptr && parse_error->byte > 0 ? parse_error->byte - 1 : 0);
    std::string said = text::json_problem(error.what());
    // It begins with the place, which is named already.
    if (const auto colon = said.find(": "); parse_error != nullptr && colon != std::string::npos)
      said.erase(0, colon + 2);
    throw PlacedError(fmt::format("{}: this is not JSON (line {}, column {}). The parser says: {}", file_.string(),
                                  line, column, said),
                      line, column);
  }
}

JsonDocument::Place JsonDocument::place(std::string_view pointer) const {
  for (;;) {
    const auto found = where_.find(std::string(pointer));
    if (found != where_.end()) return place_of(text_, found->second.shown);
    if (pointer.empty()) return {1, 1};
    pointer = pointer.substr(0, pointer.rfind('/'));
  }
}

std::optional<JsonDocument::Extent> JsonDocument::extent(std::string_view pointer) const {
  const auto found = where_.find(std::string(pointer));
  return found == where_.end() ? std::nullopt : std::optional(found->second.value);
}

std::string child_pointer(std::string_view pointer, std::string_view key) {
  std::string child(pointer);
  child += '/';
  for (const char c : key) {
    if (c == '~')
      child += "~0";
    else if (c == '/')
      child += "~1";
    else
      child += c;
  }
  return child;
}

}  // namespace tunica::experiment
