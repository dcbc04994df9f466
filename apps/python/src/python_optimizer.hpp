// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "arrays.hpp"
#include "kept.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::python {

/// The problem of one search as an optimiser written in Python sees it: valid until the search ends. Every call gives
/// the interpreter's lock up while the core evaluates.
class SearchOfOptimizer {
 public:
  explicit SearchOfOptimizer(Problem& problem) : problem_(&problem) {}
  void expire() { problem_ = nullptr; }
  [[nodiscard]] Problem& get() const;

  [[nodiscard]] pybind11::tuple evaluate(const Array& x) const;        ///< status, reason, objective
  [[nodiscard]] pybind11::tuple linearise(const Array& x) const;       ///< … objective, residuals, Jacobian
  [[nodiscard]] pybind11::tuple constraints(const Array& x) const;     ///< status, reason, values, Jacobian
  [[nodiscard]] pybind11::list evaluate_batch(const Array& xs) const;  ///< a tuple of evaluate() for each row
  [[nodiscard]] std::size_t for_each_start(std::size_t count, const pybind11::object& body) const;

 private:
  Problem* problem_;
};

/// An optimiser written in Python: an object whose minimise(search) returns (converged, reason). What it raises ends
/// the search as a failure of the optimiser, and the best point so far stays.
class PythonOptimizer final : public Optimizer {
 public:
  PythonOptimizer(const std::string& type, Needs needs, Kept object)
      : owner_("optimiser '" + type + "'"), needs_(needs), object_(std::move(object)) {}
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override;

 private:
  std::string owner_;
  Needs needs_;
  Kept object_;
};

}  // namespace tunica::python
