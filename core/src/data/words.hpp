// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

/// The words of a header.
namespace tunica::data {

/// Small letters without accents; Greek letters by their names. Bytes that are no UTF-8 are read as Latin-1.
std::string folded(std::string_view text);

/// Latin-1 as UTF-8; UTF-8 as it is.
std::string as_utf8(std::string_view text);

/// "XForce_mN" → x, force, m, n; "E11" → e, 11.
std::vector<std::string> words_of(std::string_view title);

/// Whether a word is there. One of three letters or more may also end another one ("Standardkraft"), one of four may
/// begin it; after "=" it must stand alone.
bool has_word(const std::vector<std::string>& words, std::string_view word);
bool has_any(const std::vector<std::string>& words, std::initializer_list<const char*> any);

}  // namespace tunica::data
