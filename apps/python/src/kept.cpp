// SPDX-License-Identifier: Apache-2.0
#include "kept.hpp"

#include <filesystem>
#include <variant>

#include <fmt/format.h>

namespace tunica::python {

namespace py = pybind11;

std::string reason_of(const std::string& owner, py::error_already_set& raised) {
  try {
    const auto lines = py::module_::import("traceback")
                           .attr("format_exception_only")(raised.type(), raised.value() ? raised.value() : py::none())
                           .cast<py::list>();
    const auto line = lines[lines.size() - 1].attr("strip")().cast<std::string>();
    py::object trace = raised.trace();
    std::string place;
    for (; trace && !trace.is_none(); trace = trace.attr("tb_next"))
      place = fmt::format(
          " ({}, line {})",
          std::filesystem::path(trace.attr("tb_frame").attr("f_code").attr("co_filename").cast<std::string>())
              .filename()
              .string(),
          trace.attr("tb_lineno").cast<int>());
    return fmt::format("{}: {}{}", owner, line, place);
  } catch (const py::error_already_set&) {
    return owner + ": an exception that cannot be printed";
  }
}

py::dict keywords_of(const Options& options) {
  py::dict keywords;
  for (const auto& [name, value] : options.values())
    std::visit([&, &key = name](const auto& known) { keywords[key.c_str()] = known; }, value);
  return keywords;
}

}  // namespace tunica::python
