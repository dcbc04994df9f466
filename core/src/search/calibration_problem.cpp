// SPDX-License-Identifier: Apache-2.0
#include "search/calibration_problem.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "search/oracle.hpp"
#include "search/starts.hpp"
#include "tunica/random.hpp"

namespace tunica::search {

struct CalibrationProblem::Parts {
  Parts(const assembly::Assembly& assembly, Settings given)
      : settings(std::move(given)),
        shared(assembly, settings),
        oracle(shared, Ledger({settings.stop, settings.on_failure, settings.max_failure_rate, settings.first_index}),
               settings.first_index) {}

  Settings settings;
  SharedState shared;
  Oracle oracle;
  std::optional<std::uint64_t> paired = settings.paired_starts;  ///< none after use

  /// Returns the result of one evaluation; its index is the count of `ledger` before this evaluation.
  void record(const Evaluations& made, std::size_t slot, std::uint64_t index) const {
    if (!settings.record) return;
    const std::size_t n = shared.parameters, tests = shared.tests;
    settings.record({index, std::span(made.parameters).subspan(slot * n, n), made.objectives[slot],
                     std::span(made.per_test).subspan(slot * tests, tests), made.statuses[slot], made.seconds[slot],
                     made.ended_early[slot] != 0});
  }

  static void check(const Evaluations& made, std::size_t slot) {
    if (!made.contradiction.empty() && made.contradicted == slot) throw plugins::HostFault(made.contradiction);
  }

  /// Passes newly counted evaluations to the record.
  void deliver() {
    Evaluations& made = oracle.made;
    const std::uint64_t first = oracle.ledger.next_index() - made.size();
    for (std::size_t slot = 0; slot < made.size(); ++slot) {
      check(made, slot);
      record(made, slot, first + slot);
    }
    made.clear();
  }

  /// Counts the evaluations of a start as if this problem had made them, up to the stop of the search.
  void merge(const Evaluations& made) {
    const std::size_t n = shared.parameters;
    for (const Evaluations::Call& call : made.calls) {
      if (oracle.ledger.stopped()) return;
      const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(call.size, oracle.ledger.budget()));
      for (std::size_t slot = call.first; slot < call.first + size; ++slot) {
        check(made, slot);
        const std::uint64_t index = oracle.ledger.next_index();
        oracle.ledger.add(std::span(made.parameters).subspan(slot * n, n), made.objectives[slot], made.statuses[slot],
                          call.jacobian, made.extent(slot, shared.tests));
        record(made, slot, index);
      }
    }
  }
};

CalibrationProblem::CalibrationProblem(const assembly::Assembly& assembly, Settings settings) {
  if (assembly.layout().parameters.empty()) throw InputError("every parameter is fixed: there is nothing to calibrate");
  if (assembly.layout().residual_count == 0)
    throw InputError("every row is held out: there is nothing to fit; hold out less");
  const std::size_t n = assembly.layout().parameters.size();
  if (!settings.start.empty() && settings.start.size() != n) {
    throw std::invalid_argument(fmt::format("a start of {} coordinates for {} parameters", settings.start.size(), n));
  }
  parts_ = std::make_unique<Parts>(assembly, std::move(settings));
}

CalibrationProblem::~CalibrationProblem() = default;

const Best& CalibrationProblem::best() const { return parts_->oracle.ledger.best(); }
const Tally& CalibrationProblem::tally() const { return parts_->oracle.ledger.tally(); }
StopReason CalibrationProblem::stop_reason() const { return parts_->oracle.ledger.stop_reason(); }
const std::string& CalibrationProblem::stop_sentence() const { return parts_->oracle.ledger.stop_sentence(); }

std::size_t CalibrationProblem::dimension() const { return parts_->shared.parameters; }
std::span<const double> CalibrationProblem::start() const { return parts_->shared.start; }
std::span<const ResidualBlock> CalibrationProblem::blocks() const { return parts_->shared.assembly.layout().blocks; }
std::size_t CalibrationProblem::residual_count() const { return parts_->shared.assembly.layout().residual_count; }
std::size_t CalibrationProblem::constraint_count() const { return parts_->shared.assembly.constraints().count(); }

Status CalibrationProblem::evaluate(std::span<const double> x, double& objective) {
  Status status = parts_->oracle.evaluate(x, objective);
  parts_->deliver();
  return status;
}

void CalibrationProblem::evaluate_batch(std::span<const double> xs, std::span<double> objectives,
                                        std::span<Status> statuses) {
  parts_->oracle.evaluate_batch(xs, objectives, statuses);
  parts_->deliver();
}

void CalibrationProblem::evaluate_best(std::span<const double> xs, std::size_t best, std::span<double> objectives,
                                       std::span<Status> statuses) {
  parts_->oracle.evaluate_best(xs, best, objectives, statuses);
  parts_->deliver();
}

Status CalibrationProblem::linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                                     std::span<double> jacobian) {
  Status status = parts_->oracle.linearise(x, objective, residuals, jacobian);
  parts_->deliver();
  return status;
}

Status CalibrationProblem::constraints(std::span<const double> x, std::span<double> values,
                                       std::span<double> jacobian) {
  return parts_->oracle.constraints(x, values, jacobian);
}

std::size_t CalibrationProblem::for_each_start(std::size_t count,
                                               const std::function<void(std::size_t, Problem&)>& body) {
  // Later searches continue or replace earlier ones, so only the first can be paired.
  const auto paired = std::exchange(parts_->paired, std::nullopt);
  return Starts(parts_->shared, parts_->oracle, [this](const Evaluations& made) { parts_->merge(made); })
      .run(count, parts_->settings.seed, paired, body);
}

bool CalibrationProblem::should_stop() const { return parts_->oracle.should_stop(); }
std::uint64_t CalibrationProblem::evaluations() const { return tally().evaluations; }
std::uint64_t CalibrationProblem::budget() const { return parts_->oracle.ledger.budget(); }
std::uint64_t CalibrationProblem::seed(std::string_view purpose) const {
  return derive_seed(parts_->settings.seed, purpose);
}

}  // namespace tunica::search
