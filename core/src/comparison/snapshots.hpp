// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "comparison/simulation.hpp"
#include "tunica/test.hpp"

namespace tunica::comparison {

/// "tube" or "tube:1,18,35": a test of the experiment and rows of its data, counted from 1; without rows the first, the
/// middle and the last one.
struct FieldRequest {
  std::string test;
  std::vector<std::size_t> rows;  ///< counted from 0; empty = not given
};
FieldRequest field_request(const std::string& text);

/// Asks the test for its fields. Throws InputError where the experiment has no such test or row, or the test no fields.
std::vector<Snapshot> take_snapshots(const experiment::Experiment& experiment, const Subject& subject,
                                     const FieldRequest& request);

/// The same of one test of an assembly at any values of its free parameters, with the least wave stiffness where the
/// snapshot tells the stretches, and behind the columns of the section what the row prescribes: `prescribed_pressure`.
Status take_snapshots(const assembly::Assembly& assembly, std::size_t test, const assembly::MeasuredChannel& channel,
                      std::span<const double> free, std::span<const std::size_t> rows,
                      std::vector<Snapshot>& snapshots);

/// One grid in VTK's XML format.
void write_grid(const std::filesystem::path& file, const Snapshot& snapshot);

/// Writes, for ParaView and others, directory/<test>_<row>.vtu (VTK's XML format for unstructured grids, ASCII,
/// quadrilaterals) with directory/<test>.pvd as the collection of them all, where the test has a mesh, and tables
/// directory/<test>_<row>_section.csv. Returns the files. Source: docs.vtk.org, "VTK XML Formats".
std::vector<std::filesystem::path> write_snapshots(const std::filesystem::path& directory, const std::string& test,
                                                   const std::vector<Snapshot>& snapshots);

}  // namespace tunica::comparison
