// SPDX-License-Identifier: Apache-2.0
#include "cohort/likelihood.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cohort/curve_reading.hpp"
#include "cohort/index.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

using RowMajorView = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

}  // namespace

double to_coordinate(Scale scale, double value) { return scale == Scale::log ? std::log(value) : value; }
double from_coordinate(Scale scale, double xi) { return scale == Scale::log ? std::exp(xi) : xi; }

SpecimenLikelihood::SpecimenLikelihood(Bound bound, std::size_t run, const Record::Run& best,
                                       const plugins::Catalogue& catalogue)
    : experiment_(std::make_unique<const experiment::Experiment>(std::move(bound.experiment))),
      assembly_(std::make_unique<const assembly::Assembly>(*experiment_, experiment_->runs.at(run), catalogue)),
      workspace_(assembly_->evaluator().make_workspace()) {
  const assembly::Layout& layout = assembly_->layout();
  const std::size_t n = layout.parameters.size();
  best_.resize(index(n));
  free_.resize(n);
  slope_.resize(n);
  for (std::size_t j = 0; j < n; ++j)
    best_[index(j)] = to_coordinate(layout.parameters[j].scale, best.parameters.at(j).value);
  predictions_.resize(layout.prediction_count);
  jacobian_.resize(layout.prediction_count * n);
  move_to(best_);
  if (const Status status = assembly_->evaluator().predict(free_, predictions_, {}, *workspace_); !status.ok())
    throw InputError(fmt::format("the best fit cannot be evaluated again: {}", status.reason()));
  whitening_ = assembly::whitening(*assembly_, predictions_);
  residuals_.resize(whitening_.count());
  residual_jacobian_.resize(whitening_.count() * n);
  for (const assembly::MeasuredChannel& view : layout.channels)
    if (view.weight > 0 && std::find(view.fitted.begin(), view.fitted.end(), true) != view.fitted.end()) {
      channels_.push_back(view.test + ": " + view.observable);
      stated_.push_back(view.sigma.stated());
    }
}

double SpecimenLikelihood::noise(std::size_t channel) const {
  double squares = 0;
  for (std::size_t k = first()[channel]; k < first()[channel + 1]; ++k) squares += std::pow(whitening_.rows[k].sd, 2);
  return std::sqrt(squares / static_cast<double>(first()[channel + 1] - first()[channel]));
}

bool SpecimenLikelihood::noise_is_stated(std::size_t channel) const { return stated_[channel]; }

double SpecimenLikelihood::log_noise() const {
  double sum = 0;
  for (const assembly::Whitening::Row& row : whitening_.rows) sum += 2 * std::log(row.sd);
  return sum;
}

void SpecimenLikelihood::scale_noise(std::size_t channel, double factor) {
  for (std::size_t k = first()[channel]; k < first()[channel + 1]; ++k) whitening_.rows[k].sd *= factor;
}

void SpecimenLikelihood::move_to(const Eigen::VectorXd& xi) {
  const auto& parameters = assembly_->layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double value = from_coordinate(parameters[j].scale, xi[index(j)]);
    free_[j] = std::clamp(value, parameters[j].min, parameters[j].max);
    slope_[j] = free_[j] != value ? 0 : parameters[j].scale == Scale::log ? value : 1;
  }
}

Status SpecimenLikelihood::predict(const Eigen::VectorXd& xi, Eigen::VectorXd& predictions, Eigen::MatrixXd* jacobian) {
  move_to(xi);
  Status status = assembly_->evaluator().predict(
      free_, predictions_, jacobian ? std::span<double>(jacobian_) : std::span<double>(), *workspace_);
  if (!status.ok()) return status;
  predictions = Eigen::Map<const Eigen::VectorXd>(predictions_.data(), index(predictions_.size()));
  if (jacobian)
    *jacobian = RowMajorView(jacobian_.data(), index(predictions_.size()), xi.size()) *
                Eigen::Map<const Eigen::VectorXd>(slope_.data(), xi.size()).asDiagonal();
  return status;
}

Status SpecimenLikelihood::residuals(const Eigen::VectorXd& xi, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
  move_to(xi);
  Status status = assembly_->evaluator().predict(
      free_, predictions_, jacobian ? std::span<double>(jacobian_) : std::span<double>(), *workspace_);
  if (!status.ok()) return status;
  assembly::whitened_residuals(whitening_, free_, predictions_, jacobian_, residuals_,
                               jacobian ? std::span<double>(residual_jacobian_) : std::span<double>());
  r = Eigen::Map<const Eigen::VectorXd>(residuals_.data(), index(residuals_.size()));
  if (jacobian)
    *jacobian = RowMajorView(residual_jacobian_.data(), index(residuals_.size()), xi.size()) *
                Eigen::Map<const Eigen::VectorXd>(slope_.data(), xi.size()).asDiagonal();
  return status;
}

LinearReading SpecimenLikelihood::reading(const ReadingEntry& entry) const {
  for (const assembly::MeasuredChannel& view : assembly_->layout().channels)
    if (view.test == entry.test && view.observable == entry.channel) return read_off(view, entry);
  std::string known;
  for (const assembly::MeasuredChannel& view : assembly_->layout().channels)
    known += (known.empty() ? "" : ", ") + view.test + ": " + view.observable;
  throw InputError(fmt::format("{}: there is no channel '{}' of a test '{}'. Known: {}", entry.place, entry.channel,
                               entry.test, known));
}

}  // namespace tunica::cohort
