// SPDX-License-Identifier: Apache-2.0
// What bench/build_cost.py divides by: a file of no module, of the libraries and the kind of code that the project is
// made of. Leave it as it is, or all ratios that were written down lose their meaning.
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

using Json = nlohmann::ordered_json;

std::string written(const std::string& text) {
  Json json = Json::parse(text);
  json["also"] = {{"one", 1}, {"two", {1.5, 2.5}}};
  for (const auto& [key, value] : json.items()) json[key + " again"] = value;
  return json.dump(2);
}

std::string words(const std::map<std::string, std::vector<double>>& columns) {
  std::vector<std::string> lines;
  for (const auto& [name, values] : columns)
    lines.push_back(fmt::format("{:>12}: {:.3g}, of {} values", name, fmt::join(values, ", "), values.size()));
  std::sort(lines.begin(), lines.end(), std::greater<>());
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return (A.transpose() * A).ldlt().solve(A.transpose() * b);
}
