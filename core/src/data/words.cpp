// SPDX-License-Identifier: Apache-2.0
#include "data/words.hpp"

#include <algorithm>
#include <cctype>

#include "text/escaped.hpp"

namespace tunica::data {
namespace {

struct Fold {
  const char *letter, *plain;
};
constexpr Fold folds[] = {
    {"ä", "a"}, {"ö", "o"},      {"ü", "u"},       {"Ä", "a"},     {"Ö", "o"},       {"Ü", "u"},       {"ß", "ss"},
    {"é", "e"}, {"è", "e"},      {"ê", "e"},       {"É", "e"},     {"à", "a"},       {"á", "a"},       {"â", "a"},
    {"í", "i"}, {"î", "i"},      {"ó", "o"},       {"ô", "o"},     {"ú", "u"},       {"ù", "u"},       {"ñ", "n"},
    {"ç", "c"}, {"λ", "lambda"}, {"ε", "epsilon"}, {"σ", "sigma"}, {"Δ", " delta "}, {"θ", " theta "}, {"µ", "u"},
    {"μ", "u"}, {"²", "^2"},     {"°", " deg "}};

bool is(int (*kind)(int), char letter) { return kind(static_cast<unsigned char>(letter)) != 0; }

}  // namespace

std::string as_utf8(std::string_view text) {
  if (text::is_utf8(text)) return std::string(text);
  std::string found;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x80) {
      found += letter;
    } else {
      found += static_cast<char>(0xC0 | byte >> 6);
      found += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return found;
}

std::string folded(std::string_view text) {
  const std::string utf8 = as_utf8(text);
  std::string plain;
  for (std::size_t at = 0; at < utf8.size();) {
    const auto* const fold = std::find_if(std::begin(folds), std::end(folds), [&](const Fold& one) {
      return std::string_view(utf8).substr(at).starts_with(one.letter);
    });
    if (fold != std::end(folds)) {
      plain += fold->plain;
      at += std::string_view(fold->letter).size();
    } else {
      plain += is(std::isprint, utf8[at]) ? utf8[at] : ' ';
      ++at;
    }
  }
  return plain;
}

std::vector<std::string> words_of(std::string_view title) {
  const std::string text = folded(title);
  std::vector<std::string> words(1);
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char letter = text[at], last = at == 0 ? ' ' : text[at - 1];
    const bool lower_next = at + 1 < text.size() && is(std::islower, text[at + 1]);
    const bool begins =
        (is(std::isupper, letter) && (is(std::islower, last) || (is(std::isupper, last) && lower_next))) ||
        (is(std::isdigit, letter) != is(std::isdigit, last) && is(std::isalnum, last));
    if ((begins || !is(std::isalnum, letter)) && !words.back().empty()) words.emplace_back();
    if (is(std::isalnum, letter)) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool has_word(const std::vector<std::string>& words, std::string_view word) {
  const bool alone = word.starts_with('=');
  if (alone) word.remove_prefix(1);
  return std::any_of(words.begin(), words.end(), [&](const std::string& one) {
    return one == word || (!alone && word.size() >= 3 && one.ends_with(word)) ||
           (!alone && word.size() >= 4 && one.starts_with(word));
  });
}

bool has_any(const std::vector<std::string>& words, std::initializer_list<const char*> any) {
  return std::any_of(any.begin(), any.end(), [&](const char* word) { return has_word(words, word); });
}

}  // namespace tunica::data
