// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

/// A reader of cards that knows nothing of their writer.
namespace tunica::trial {

inline std::vector<double> numbers(std::string text) {
  for (char& c : text)
    if (c == ',') c = ' ';
  std::istringstream stream(text);
  std::vector<double> found;
  for (double value; stream >> value;) found.push_back(value);
  return found;
}

/// The lines of a card without those that begin with `comment`.
inline std::vector<std::string> lines_of(const std::string& card, const std::string& comment) {
  std::vector<std::string> lines;
  std::istringstream stream(card);
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with(comment)) lines.push_back(line);
  return lines;
}

/// The data lines behind the keyword line that contains `keyword` (Abaqus, CalculiX).
inline std::vector<double> data_of(const std::string& card, const std::string& keyword) {
  std::string data;
  bool within = false;
  for (const auto& line : lines_of(card, "**")) {
    const bool parameters = line.find('=') != std::string::npos;
    if (line.starts_with("*"))
      within = line.find(keyword) != std::string::npos;
    else if (within && !parameters)
      data += line + "\n";
  }
  return numbers(data);
}

/// The directions in the *ORIENTATION of an Abaqus card's comment: lines of three numbers.
inline std::vector<Eigen::Vector3d> directions_of(const std::string& card) {
  std::vector<Eigen::Vector3d> found;
  std::istringstream stream(card);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("** "))
      if (const auto row = numbers(line.substr(3)); row.size() == 3) found.emplace_back(row[0], row[1], row[2]);
  return found;
}

/// The invariants of a state with det C = 1, in the axes circumferential, axial, radial.
struct State {
  Eigen::Matrix3d C;
  [[nodiscard]] double i1() const { return C.trace(); }
  [[nodiscard]] double i2() const { return (i1() * i1() - (C * C).trace()) / 2; }
  [[nodiscard]] double along(const Eigen::Vector3d& direction) const { return direction.dot(C * direction); }
  /// Σ λ^α − 3
  [[nodiscard]] double powers(double alpha) const {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues().array().pow(alpha / 2).sum() - 3;
  }
};

}  // namespace tunica::trial
