// SPDX-License-Identifier: Apache-2.0
#include "report/page.hpp"

#include <fmt/format.h>

#include "report/html.hpp"
#include "report/page_parts.hpp"

namespace tunica::report {

void Page::part(const std::string& name) {
  in_part_ = false;
  body_ += "<hr>\n";
  section(name);
  in_part_ = true;
}

void Page::section(const std::string& heading) {
  const std::string anchor = fmt::format("s{}", ++sections_);
  body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n", anchor, escaped(heading));
  if (!in_part_) contents_.emplace_back(anchor, heading);
}

void Page::heading(const std::string& text) { body_ += fmt::format("<h3>{}</h3>\n", escaped(text)); }

void Page::paragraph(const std::string& text, const char* style) {
  body_ += fmt::format("<p class=\"{}\">{}</p>\n", style, escaped(text));
}

void Page::box(const char* kind, const std::string& head, const std::vector<std::string>& items, std::size_t shown) {
  body_ += fmt::format("<div class=\"box {}\"><strong>{}</strong>", kind, escaped(head));
  const auto list = [&](std::size_t from, std::size_t to) {
    body_ += "<ul>";
    for (std::size_t k = from; k < to; ++k) body_ += fmt::format("<li>{}</li>", escaped(items[k]));
    body_ += "</ul>";
  };
  if (!items.empty()) list(0, std::min(shown, items.size()));
  if (items.size() > shown) {
    body_ += fmt::format("<details><summary>{} more</summary>", items.size() - shown);
    list(shown, items.size());
    body_ += "</details>";
  }
  body_ += "</div>\n";
}

void Page::words(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<std::pair<std::string, std::vector<std::string>>> lists;
  for (const auto& [name, text] : pairs)
    if (!text.empty()) lists.push_back({name, {text}});
  word_lists(lists);
}

void Page::word_lists(const std::vector<std::pair<std::string, std::vector<std::string>>>& pairs, std::size_t shown) {
  body_ += "<dl class=\"words\">";
  for (const auto& [name, lines] : pairs) {
    if (lines.empty()) continue;
    body_ += fmt::format("<dt>{}</dt><dd>", escaped(name));
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (k == shown) body_ += fmt::format("<details><summary>{} more</summary>", lines.size() - shown);
      body_ += fmt::format("<div>{}</div>", escaped(lines[k]));
    }
    body_ += lines.size() > shown ? "</details></dd>" : "</dd>";
  }
  body_ += "</dl>\n";
}

void Page::begin_fold(const std::string& summary) {
  body_ += fmt::format("<details class=\"waits\"><summary>{}</summary><div class=\"many\">\n", escaped(summary));
}

void Page::command(const std::string& text) { body_ += fmt::format("<pre>{}</pre>\n", escaped(text)); }

void Page::chart(const Chart& chart, const std::string& folder) {
  if (chart.empty()) return;
  const std::string place = folder.empty() ? "./" : folder + "/";
  std::string links;
  for (const std::string& file : chart.files)
    links += fmt::format(" <a href=\"{}\">{}</a>", address(fmt::format("{}{}", place, file)), escaped(file));
  body_ += fmt::format(
      "<figure data-chart=\"{}\"><figcaption>{}<small>{}</small></figcaption><div class=\"legend\" role=\"group\" "
      "aria-label=\"Series of {}\"></div><div class=\"plot\"></div><div class=\"tools\">{}</div></figure>\n",
      charts_.size(), escaped(chart.title), escaped(chart.note), escaped(chart.title),
      links.empty() ? "" : "<span>All values:" + links + "</span>");
  charts_.push_back(chart.json());
}

std::string Page::document() const {
  const std::string library(page_library), script(page_script), style(page_style);
  std::string contents;
  for (const auto& [anchor, heading] : contents_)
    contents += fmt::format("<a href=\"#{}\">{}</a>", anchor, escaped(heading));
  // The policy allows no address except the page itself, and no script except the two below, whatever names in the data
  // contain.
  const std::string policy = fmt::format(
      "default-src 'none'; script-src {} {}; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
      "form-action 'none'",
      policy_source(library), policy_source(script));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<link rel=\"icon\" href=\"data:,\">\n<style>{}</style>\n</head>\n<body>\n"
      "<header><h1>{}</h1><button type=\"button\" id=\"theme\">Light / dark</button></header>\n<main>\n"
      "<nav aria-label=\"Contents\">{}</nav>\n<noscript><p>Charts need JavaScript; words and tables are all "
      "here.</p></noscript>\n{}</main>\n"
      "<footer class=\"muted\"><p>Charts: drag to zoom, double-click or 0 for the whole range, arrow keys to read "
      "values, + and - to zoom. This file needs no network.</p></footer>\n"
      "<script type=\"application/json\" id=\"charts\">{}</script>\n<script>{}</script>\n<script>{}</script>\n"
      "</body>\n</html>\n",
      escaped(policy), escaped(title_), style, escaped(title_), contents, body_, script_json(charts_), library, script);
}

namespace {

/// A long name in a table may be broken after an underscore.
std::string cell_html(const Cell& cell) {
  constexpr std::size_t long_text = 24;
  std::string text = escaped(cell.text);
  if (!cell.link.empty()) return fmt::format("<a href=\"{}\">{}</a>", address(cell.link), text);
  if (cell.number || text.size() <= long_text) return text;
  std::string broken;
  for (const char c : text) broken.append(1, c).append(c == '_' ? "<wbr>" : "");
  return broken;
}

}  // namespace

std::string table_html(const std::vector<std::string>& head, const std::vector<std::vector<Cell>>& rows,
                       const std::vector<bool>& first) {
  std::string text = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Table\"><table><thead><tr>";
  for (std::size_t k = 0; k < head.size(); ++k)
    text += fmt::format("<th{} scope=\"col\">{}</th>",
                        !rows.empty() && k < rows.front().size() && rows.front()[k].number ? " class=\"n\"" : "",
                        escaped(head[k]));
  text += "</tr></thead><tbody>";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += r < first.size() && first[r] ? "<tr class=\"first\">" : "<tr>";
    for (const Cell& cell : rows[r])
      text += fmt::format("<td class=\"{}{}\">{}</td>", cell.number ? "n" : "", cell.bad ? " no" : "", cell_html(cell));
    text += "</tr>";
  }
  return text + "</tbody></table></div>\n";
}

std::string sortable_html(const std::vector<std::string>& head, const std::vector<std::vector<Cell>>& rows) {
  return "<div class=\"sortable\">" + table_html(head, rows) + "</div>\n";
}

}  // namespace tunica::report
