// SPDX-License-Identifier: Apache-2.0
#include "comparison/snapshots.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "execution/files.hpp"
#include "stability/ellipticity.hpp"
#include "text/units.hpp"
#include "tunica/error.hpp"
#include "tunica/test.hpp"

namespace tunica::comparison {
namespace {

std::size_t row_number(const std::string& word, const std::string& text) {
  std::size_t row = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), row);
  if (error != std::errc() || end != word.data() + word.size() || row == 0)
    throw InputError(
        fmt::format("--fields {}: '{}' is not a row; rows are counted from 1, for example tube:1,18,35", text, word));
  return row - 1;
}

/// The text of a file before it is written.
struct Text {
  fmt::memory_buffer buffer;

  template <class... Values>
  void print(fmt::format_string<Values...> form, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer), form, std::forward<Values>(values)...);
  }
  void write(const std::filesystem::path& file) const {
    execution::write_atomically(file, {buffer.data(), buffer.size()});
  }
};

void write_array(Text& out, const std::string& name, const std::string& unit, std::size_t components,
                 const std::vector<double>& values) {
  out.print("        <DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
            text::titled(name, unit), components);
  for (std::size_t i = 0; i < values.size(); ++i) out.print("{}{}", values[i], (i + 1) % components == 0 ? '\n' : ' ');
  out.print("        </DataArray>\n");
}

void write_fields(Text& out, const char* place, const Snapshot& snapshot, bool of_cells) {
  out.print("      <{}>\n", place);
  for (const auto& field : snapshot.fields)
    if (field.of_cells == of_cells) write_array(out, field.name, field.unit, field.components, field.values);
  out.print("      </{}>\n", place);
}

/// Where a snapshot tells the stretches: how far the material is from losing ellipticity there, the shear near a clamp
/// left aside; not positive = lost.
void add_ellipticity(const TestInput& input, Snapshot& snapshot) {
  if (input.model.describe().history_size > 0 || input.layers.size() > 1) return;
  const std::array<const char*, 3> names{"circumferential_stretch", "axial_stretch", "radial_stretch"};
  const auto margin = [&](const auto& has) {
    std::array<const std::vector<double>*, 3> stretch{};
    for (std::size_t a = 0; a < 3; ++a)
      for (const auto& one : has)
        if (one.name == names[a]) stretch[a] = &one.values;
    std::vector<double> found;
    if (std::ranges::count(stretch, nullptr) > 0) return found;
    for (std::size_t i = 0; i < stretch[0]->size(); ++i)
      found.push_back(stability::least_wave_stiffness(input.model, input.model_parameters,
                                                      {(*stretch[0])[i], (*stretch[1])[i], (*stretch[2])[i]})
                          .value_or(std::numeric_limits<double>::quiet_NaN()));
    return found;
  };
  if (std::vector<double> found = margin(snapshot.fields); !found.empty())
    snapshot.fields.push_back({"least_wave_stiffness", "kPa", 1, true, std::move(found)});
  if (std::vector<double> found = margin(snapshot.section); !found.empty())
    snapshot.section.push_back({"least_wave_stiffness", "kPa", std::move(found)});
}

}  // namespace

void write_grid(const std::filesystem::path& file, const Snapshot& snapshot) {
  constexpr int quadrilateral = 9;  // VTK_QUAD
  const std::size_t cells = snapshot.cells.size() / 4;
  Text out;
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n");
  out.print("  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
            snapshot.points.size() / 3, cells);
  out.print("      <Points>\n");
  write_array(out, "points", "mm", 3, snapshot.points);
  out.print("      </Points>\n      <Cells>\n");
  out.print("        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
  for (std::size_t i = 0; i < snapshot.cells.size(); ++i) out.print("{}{}", snapshot.cells[i], i % 4 == 3 ? '\n' : ' ');
  out.print("        </DataArray>\n        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
  for (std::size_t i = 1; i <= cells; ++i) out.print("{}\n", 4 * i);
  out.print("        </DataArray>\n        <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
  for (std::size_t i = 0; i < cells; ++i) out.print("{}\n", quadrilateral);
  out.print("        </DataArray>\n      </Cells>\n");
  write_fields(out, "PointData", snapshot, false);
  write_fields(out, "CellData", snapshot, true);
  out.print("    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n");
  out.write(file);
}

FieldRequest field_request(const std::string& text) {
  FieldRequest request;
  const auto colon = text.rfind(':');
  request.test = text.substr(0, colon);
  if (colon == std::string::npos) return request;
  std::string rest = text.substr(colon + 1) + ',';
  for (std::size_t begin = 0, end = rest.find(','); end != std::string::npos;
       begin = end + 1, end = rest.find(',', begin))
    request.rows.push_back(row_number(rest.substr(begin, end - begin), text));
  return request;
}

std::vector<Snapshot> take_snapshots(const experiment::Experiment& experiment, const Subject& subject,
                                     const FieldRequest& request) {
  const auto test = std::ranges::find(experiment.tests, request.test, &experiment::TestEntry::name);
  if (test == experiment.tests.end())
    throw InputError(fmt::format("--fields {}: the experiment has no test of that name", request.test));
  const auto& channels = subject.assembly->layout().channels;
  const auto channel = std::ranges::find(channels, request.test, &assembly::MeasuredChannel::test);
  const std::size_t count = channel == channels.end() ? 0 : channel->count;
  std::vector<std::size_t> rows = request.rows;
  if (rows.empty() && count > 0) rows = {0, count / 2, count - 1};
  for (const std::size_t row : rows)
    if (row >= count)
      throw InputError(fmt::format("--fields {}: there is no row {}; the test has {}", request.test, row + 1, count));
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());

  std::vector<Snapshot> snapshots;
  const auto number = static_cast<std::size_t>(test - experiment.tests.begin());
  if (channel == channels.end()) return snapshots;
  const Status status = take_snapshots(*subject.assembly, number, *channel, subject.free, rows, snapshots);
  if (!status.ok()) throw InputError(fmt::format("--fields {}: {}", request.test, status.reason()));
  return snapshots;
}

Status take_snapshots(const assembly::Assembly& assembly, std::size_t test, const assembly::MeasuredChannel& channel,
                      std::span<const double> free, std::span<const std::size_t> rows,
                      std::vector<Snapshot>& snapshots) {
  return assembly.evaluator().ask(test, free, [&](const Test& asked, const TestInput& input) {
    Status made = asked.snapshots(input, rows, snapshots);
    for (Snapshot& snapshot : snapshots) {
      add_ellipticity(input, snapshot);
      if (snapshot.section.empty()) continue;
      const std::size_t points = snapshot.section.front().values.size();
      snapshot.section.push_back({"prescribed_" + channel.abscissa_name, channel.abscissa_unit,
                                  std::vector<double>(points, channel.abscissa[snapshot.row])});
    }
    return made;
  });
}

std::vector<std::filesystem::path> write_snapshots(const std::filesystem::path& directory, const std::string& test,
                                                   const std::vector<Snapshot>& snapshots) {
  std::vector<std::filesystem::path> files;
  std::string collection;
  for (const Snapshot& snapshot : snapshots) {
    const std::string stem = fmt::format("{}_{}", test, snapshot.row + 1);
    if (!snapshot.cells.empty()) {
      files.push_back(directory / (stem + ".vtu"));
      write_grid(files.back(), snapshot);
      collection += fmt::format("    <DataSet timestep=\"{}\" file=\"{}.vtu\"/>\n", snapshot.row + 1, stem);
    }
    if (snapshot.section.empty()) continue;
    SimulatedTable table{stem + "_section", {}, {}};
    for (const auto& column : snapshot.section) {
      table.headers.push_back(fmt::format("{} [{}]", column.name, column.unit));
      table.columns.push_back(column.values);
    }
    files.push_back(write_table(directory, table));
  }
  if (collection.empty()) return files;
  files.push_back(directory / (test + ".pvd"));
  Text out;
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n{}  </Collection>\n</VTKFile>\n",
      collection);
  out.write(files.back());
  return files;
}

}  // namespace tunica::comparison
