// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace tunica {

/// The outcome of one evaluation.
///
/// Models, tests and problems return it; a test passes on what its model returned. The host counts failures, prints the
/// most frequent reasons and goes on as `on_failure` of the experiment file says.
///
/// A point that cannot be evaluated is neither an exception nor a magic number: it is `failed`, with a reason that a
/// person can act on. Searches go on after it. `infeasible` means that the point was evaluated and violates a
/// constraint. Wrong input is an exception, see InputError; a bug is an assertion.
///
///     if (!std::isfinite(stress)) return Status::failed("bulge: the energy overflows at row " + std::to_string(i));
class [[nodiscard]] Status {
 public:
  /// The three outcomes.
  enum class Kind {
    ok,          ///< evaluated, and no constraint is violated
    infeasible,  ///< evaluated, but a constraint is violated
    failed       ///< not evaluated; no output of the call may be read
  };

  /// The outcome ok. It allocates nothing.
  Status() = default;
  /// An evaluated point that violates constraints. `violation` > 0 is the sum of the positive constraint values; it
  /// ranks infeasible points among each other.
  static Status infeasible(std::string reason, double violation) {
    return {Kind::infeasible, std::move(reason), violation};
  }
  /// A point that could not be evaluated.
  ///
  /// The reason names what failed and where (row, abscissa, iteration) and, if
  /// that is known, what to do. Reports print it.
  static Status failed(std::string reason) { return {Kind::failed, std::move(reason), 0}; }

  /// Which of the three outcomes. Reading a status is safe from any thread. Decide on it, never on the words of
  /// reason().
  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] bool ok() const { return kind_ == Kind::ok; }          ///< whether the outcome is Kind::ok
  [[nodiscard]] const std::string& reason() const { return reason_; }  ///< empty if ok
  [[nodiscard]] double violation() const { return violation_; }        ///< 0 unless infeasible

 private:
  Status(Kind kind, std::string reason, double violation)
      : kind_(kind), reason_(std::move(reason)), violation_(violation) {}
  Kind kind_ = Kind::ok;
  std::string reason_;
  double violation_ = 0;
};

/// The code of an outcome in evaluations.csv and result.json: "ok", "infeasible" or "failed".
///
/// Codes are stable, and scripts may rely on them; the words of a reason are not.
inline const char* name(Status::Kind kind) {
  return kind == Status::Kind::ok ? "ok" : kind == Status::Kind::infeasible ? "infeasible" : "failed";
}

}  // namespace tunica
