// SPDX-License-Identifier: Apache-2.0
#include "cohort/template.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/json_document.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

using experiment::Json;
using experiment::JsonDocument;

[[noreturn]] void refuse_pointer(const Binding& binding, const JsonDocument& document) {
  // The longest part of the pointer that leads somewhere, and what stands below it.
  std::string reached = binding.pointer;
  while (!reached.empty() && !document.extent(reached)) reached.resize(reached.rfind('/') + 0);
  std::string below;
  if (const Json& value = document.root().at(Json::json_pointer(reached)); value.is_object())
    for (const auto& [key, child] : value.items()) below += (below.empty() ? "" : ", ") + key;
  throw InputError(
      fmt::format("{}: the experiment {} has no value at '{}'. '{}' holds: {}. Put a value there that the specimens "
                  "replace",
                  binding.place, document.file().string(), binding.pointer, reached.empty() ? "/" : reached, below));
}

}  // namespace

Template::Template(const Specification& cohort, const SpecimenTable& table)
    : text_(data::read_bytes(cohort.experiment)), table_(table.file), columns_(table.columns) {
  const JsonDocument document(cohort.experiment, text_);
  text_ = document.text();
  for (const Binding& binding : cohort.bindings) {
    if (!binding.pointer.starts_with('/'))
      throw InputError(
          fmt::format("{}: '{}' is no JSON pointer. Write a path that begins with '/', for example "
                      "/tests/strip/data/file",
                      binding.place, binding.pointer));
    const auto extent = document.extent(binding.pointer);
    if (!extent) refuse_pointer(binding, document);
    const Json& value = document.root().at(Json::json_pointer(binding.pointer));
    if (value.is_structured())
      throw InputError(fmt::format("{}: '{}' is {} in the experiment. Bind a single value, a text or a number",
                                   binding.place, binding.pointer, value.is_object() ? "an object" : "a list"));
    Hole hole{extent->begin, extent->end, value.is_number(), {}, binding.place};
    const std::string& pattern = binding.pattern;
    std::size_t from = 0;
    for (std::size_t open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', from)) {
      const std::size_t close = pattern.find('}', open);
      if (close == std::string::npos)
        throw InputError(
            fmt::format("{}: in '{}' a brace opens and does not close. Write {{column}}", binding.place, pattern));
      const std::string name = pattern.substr(open + 1, close - open - 1);
      const bool is_column = std::any_of(columns_.begin(), columns_.end(),
                                         [&](const auto& one) { return one.name == name || one.text == name; });
      // {id} means the id whatever its column is called.
      const std::size_t column = name == "id" && !is_column ? table.id : table.column(name, binding.place);
      hole.pieces.push_back({pattern.substr(from, open - from), column});
      from = close + 1;
    }
    hole.pieces.push_back({pattern.substr(from), {}});
    holes_.push_back(std::move(hole));
  }
  std::sort(holes_.begin(), holes_.end(), [](const Hole& a, const Hole& b) { return a.begin < b.begin; });
}

std::string Template::of(const Specimen& specimen) const {
  std::string text;
  std::size_t from = 0;
  for (const Hole& hole : holes_) {
    std::string value;
    for (const Piece& piece : hole.pieces) {
      value += piece.literal;
      if (!piece.column) continue;
      const data::Csv::Column& column = columns_[*piece.column];
      const std::string& cell = specimen.cells[*piece.column];
      if (cell.empty())
        throw InputError(fmt::format("{}, line {}: the column '{}' is empty. Fill it in, or take the row out",
                                     table_.string(), specimen.line, column.name));
      value += column.unit ? cell + " " + *column.unit : cell;
    }
    // A number where the template has one; a quantity with its unit is a text.
    const bool plain = hole.number && Json::accept(value) && Json::parse(value).is_number();
    text.append(text_, from, hole.begin - from);
    text += plain ? value : Json(value).dump();
    from = hole.end;
  }
  return text.append(text_, from);
}

}  // namespace tunica::cohort
