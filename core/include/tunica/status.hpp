// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace tunica {

/// What became of one evaluation. A point that cannot be evaluated is neither an exception nor a magic number:
/// it is `failed` with a reason a person can act on. `infeasible` means the point was evaluated, and violates a
/// constraint. Wrong input is an exception (error.hpp); a bug is an assertion.
class [[nodiscard]] Status {
 public:
  /// `failed`: no value, and nothing else of the evaluation may be read.
  enum class Kind { ok, infeasible, failed };

  Status() = default;  ///< ok; allocates nothing
  /// `violation` > 0: the sum of the positive constraint values, by which infeasible points can be ranked.
  static Status infeasible(std::string reason, double violation) {
    return {Kind::infeasible, std::move(reason), violation};
  }
  /// The reason says what, where (row, abscissa, iteration) and, where known, what to do; it goes into the report.
  static Status failed(std::string reason) { return {Kind::failed, std::move(reason), 0}; }

  [[nodiscard]] Kind kind() const { return kind_; }                    ///< what became of it
  [[nodiscard]] bool ok() const { return kind_ == Kind::ok; }          ///< evaluated, and no constraint broken
  [[nodiscard]] const std::string& reason() const { return reason_; }  ///< empty under ok
  [[nodiscard]] double violation() const { return violation_; }        ///< 0 unless infeasible

 private:
  Status(Kind kind, std::string reason, double violation)
      : kind_(kind), reason_(std::move(reason)), violation_(violation) {}
  Kind kind_ = Kind::ok;
  std::string reason_;
  double violation_ = 0;
};

/// "ok", "infeasible", "failed": the words of evaluations.csv and result.json.
inline const char* name(Status::Kind kind) {
  return kind == Status::Kind::ok ? "ok" : kind == Status::Kind::infeasible ? "infeasible" : "failed";
}

}  // namespace tunica
