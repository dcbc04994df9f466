// SPDX-License-Identifier: Apache-2.0
#include "data/file_text.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "data/dmc.hpp"
#include "data/labchart.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

/// How files of MATLAB before version 7.3 begin.
constexpr std::string_view matlab_magic = "MATLAB 5.0 MAT-file";

/// Files that are no text, by their first bytes.
void refuse_binary(const std::filesystem::path& file, std::string_view bytes) {
  const auto is_no_text = [&](std::string_view kind, std::string_view cure) {
    throw InputError(fmt::format("{}: this is {}, and a table as text is expected. {}", file.string(), kind, cure));
  };
  constexpr std::string_view save =
      "Open it in its program, and save the sheet with the rows as CSV (comma separated values).";
  if (bytes.starts_with("PK\x03\x04")) is_no_text("a workbook (.xlsx, .ods) or another archive", save);
  if (bytes.starts_with("\xD0\xCF\x11\xE0")) is_no_text("a workbook (.xls) or another document of Office", save);
  const std::string_view head = bytes.substr(0, 1000);
  if (head.starts_with("<") && head.find("urn:schemas-microsoft-com:office") != std::string_view::npos)
    is_no_text("a workbook as XML", save);
  if (head.starts_with("<html") || head.starts_with("<HTML") || head.starts_with("<!DOCTYPE"))
    is_no_text("a web page", save);
  if (bytes.starts_with("\x89HDF") || bytes.starts_with(matlab_magic))
    is_no_text("a file of MATLAB or HDF5", "Write its columns as CSV.");
  if (bytes.starts_with("TDSm"))
    is_no_text("a TDMS file of LabVIEW", "Open it with its add-in for spreadsheets, and save the sheet as CSV.");
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 0x3F));
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 0x3F));
    add(0x80 | (code >> 6 & 0x3F));
  }
  add(0x80 | (code & 0x3F));
}

/// UTF-16 behind its byte order mark.
std::string from_utf16(std::string_view bytes) {
  const bool little = bytes.front() == '\xFF';
  const auto unit = [&](std::size_t at) {
    const auto a = static_cast<unsigned char>(bytes[at]), b = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<std::uint32_t>(little ? a | b << 8 : b | a << 8);
  };
  std::string text;
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    if (code >= 0xD800 && code < 0xDC00 && at + 3 < bytes.size() && (unit(at + 2) & 0xFC00) == 0xDC00) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(at + 2) - 0xDC00);
      at += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = 0xFFFD;
    }
    append_utf8(text, code);
  }
  return text;
}

void refuse_encodings(const std::filesystem::path& file, std::string_view text) {
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos)
    throw InputError(fmt::format(
        "{}, line {}: found a zero byte, so this is not a text file. Expected CSV: a header line "
        "`name [unit]` and rows of numbers.",
        file.string(), 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n')));
}

}  // namespace

std::string_view text_of(const std::filesystem::path& file, std::string_view bytes, std::string& decoded) {
  refuse_binary(file, bytes);
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) bytes = decoded = from_utf16(bytes);
  refuse_encodings(file, bytes);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (std::string table; labchart_as_table(file, bytes, table) || dmc_as_table(file, bytes, table))
    bytes = decoded = std::move(table);
  return bytes;
}

}  // namespace tunica::data
