// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace tunica::um_bridge {

/// A model on a server of the protocol UM-Bridge 1.0 (https://um-bridge-benchmarks.readthedocs.io). Every request opens
/// a connection of its own, so that several threads ask side by side.
///
/// Errors: all functions throw std::runtime_error that says what was asked of whom, and what came back.
class Connection {
 public:
  /// `url` "http://host:port". `seconds` limit each exchange as a whole, from the connection to the last byte of the
  /// answer; `interrupted` is asked a hundred times a second whether to give it up before.
  Connection(std::string url, std::string model, nlohmann::json config, double seconds,
             std::function<bool()> interrupted);

  /// Throws also where the server speaks another version, or has no such model.
  void greet() const;
  [[nodiscard]] std::vector<std::size_t> input_sizes() const;
  [[nodiscard]] std::vector<std::size_t> output_sizes() const;
  [[nodiscard]] bool supports(const char* feature) const;
  using Vectors = std::vector<std::vector<double>>;
  [[nodiscard]] Vectors evaluate(const Vectors& input) const;
  /// The product of one output's Jacobian by one input with a vector.
  [[nodiscard]] std::vector<double> apply_jacobian(std::size_t output, std::size_t input, const Vectors& at,
                                                   const std::vector<double>& vector) const;

 private:
  [[nodiscard]] nlohmann::json ask(const std::string& path, const nlohmann::json* request) const;
  [[nodiscard]] nlohmann::json request() const;
  [[nodiscard]] std::string source(const char* path) const { return url_ + path; }
  std::string url_, model_;
  nlohmann::json config_;
  double seconds_;
  std::function<bool()> interrupted_;
};

}  // namespace tunica::um_bridge
