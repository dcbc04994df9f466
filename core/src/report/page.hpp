// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/chart.hpp"

namespace tunica::report {

/// A page that is filled from top to bottom: sections of words, tables and charts. What is put in as text is escaped
/// here; functions that take HTML say so.
class Page {
 public:
  explicit Page(std::string title) : title_(std::move(title)) {}

  /// The report of one of several folders begins; the contents list it instead of its sections.
  void part(const std::string& name);
  /// A heading, and an entry of the contents.
  void section(const std::string& heading);
  void heading(const std::string& text);
  void paragraph(const std::string& text, const char* style = "");
  /// A coloured box: "good", "bad" or "". More than `shown` items are folded away.
  void box(const char* kind, const std::string& head, const std::vector<std::string>& items = {},
           std::size_t shown = 6);
  /// Pairs of a name and words.
  void words(const std::vector<std::pair<std::string, std::string>>& pairs);
  /// The same where a name has several lines; more than `shown` are folded away.
  void word_lists(const std::vector<std::pair<std::string, std::vector<std::string>>>& pairs, std::size_t shown = 3);
  void command(const std::string& text);
  void html(std::string_view trusted) { body_ += trusted; }
  /// Draws it where it is put in; nothing for an empty chart. Its tables are looked for in `folder`, an address
  /// relative to the page.
  void chart(const Chart& chart, const std::string& folder = "");
  /// A fold whose charts are drawn when it is opened, beside each other as many as there is room for.
  void begin_fold(const std::string& summary);
  void end_fold() { body_ += "</div></details>\n"; }
  void begin_pair() { body_ += "<div class=\"pair\">"; }
  void end_pair() { body_ += "</div>\n"; }

  [[nodiscard]] std::size_t chart_count() const { return charts_.size(); }
  /// The whole document.
  [[nodiscard]] std::string document() const;

 private:
  std::string title_, body_;
  std::vector<std::pair<std::string, std::string>> contents_;
  Json charts_ = Json::array();
  std::size_t sections_ = 0;
  bool in_part_ = false;
};

/// A cell: text, or a number to be set right.
struct Cell {
  std::string text;
  bool number = false, bad = false;
  std::string link = {};  ///< relative address
};
/// The same as a table that the reader can sort and filter.
std::string sortable_html(const std::vector<std::string>& head, const std::vector<std::vector<Cell>>& rows);
/// The table as HTML; the rows of `first` stand out.
std::string table_html(const std::vector<std::string>& head, const std::vector<std::vector<Cell>>& rows,
                       const std::vector<bool>& first = {});

}  // namespace tunica::report
