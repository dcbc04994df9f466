// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/cholesky.hpp"

namespace tunica::diagnosis {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double promised = 1e-6;  ///< of |r|², in noise units
constexpr double box_edge = 1e-9;  ///< of the unit box
constexpr double hopeless = 0.01;  ///< of what is missing to a wanted |r|²
constexpr int patience = 2;        ///< such steps
constexpr std::size_t creep = 6;   ///< steps that have to gain something together

class Descent {
 public:
  Descent(const assembly::Assembly& assembly, const std::vector<Variable>& variables, std::span<const double> start,
          assembly::Workspace& workspace, const DataVariant& data)
      : assembly_(assembly),
        variables_(variables),
        workspace_(workspace),
        data_(data),
        free_(start.begin(), start.end()),
        unit_(start.size()),
        x_(static_cast<Eigen::Index>(variables.size())) {
    assembly.box().to_unit(free_, unit_);
    for (std::size_t k = 0; k < variables.size(); ++k)
      x_[static_cast<Eigen::Index>(k)] = std::clamp(unit_[variables[k].front()], 0.0, 1.0);
    move_to(x_);
  }

  Fit run(std::size_t max_evaluations) {
    Fit fit;
    const bool secant = !assembly_.layout().jacobian_is_exact;
    if (fit.status = evaluate(r_, &J_); !fit.status.ok()) return fit;
    double squares = r_.squaredNorm(), damping = 1e-4, growth = 2;
    bool fresh = true, shortened = false;
    while (evaluations_ < max_evaluations) {
      const Eigen::VectorXd gradient = J_.transpose() * r_;
      std::vector<Eigen::Index> moving;
      for (Eigen::Index k = 0; k < x_.size(); ++k)
        if (!((x_[k] <= box_edge && gradient[k] > 0) || (x_[k] >= 1 - box_edge && gradient[k] < 0)))
          moving.push_back(k);
      if (moving.empty()) break;
      const Eigen::MatrixXd A = J_(Eigen::all, moving);
      Eigen::MatrixXd normal = A.transpose() * A;
      const Eigen::VectorXd g = gradient(moving), diagonal = normal.diagonal();
      for (Eigen::Index k = 0; k < normal.rows(); ++k) normal(k, k) += damping * std::max(diagonal[k], 1e-12);
      const Eigen::VectorXd step = numerics::solve_symmetric(normal, -g);
      Eigen::VectorXd trial = x_;
      for (std::size_t k = 0; k < moving.size(); ++k)
        trial[moving[k]] = std::clamp(x_[moving[k]] + step[static_cast<Eigen::Index>(k)], 0.0, 1.0);
      const Eigen::VectorXd moved = trial - x_, linear = J_ * moved;
      const double expected = -(2 * r_.dot(linear) + linear.squaredNorm());
      if (!(expected > promised)) {
        // A step that bounds cut off may lead uphill; a step closer to steepest descent does not.
        if (expected <= 0 && (moved(moving) - step).norm() > 1e-9 * step.norm() && damping < 1e8) {
          damping *= 10;
          shortened = true;
          continue;
        }
        // If a secant Jacobian gives no descent, it is recomputed once, provided that the point has moved since it was
        // exact.
        if (secant && !fresh && evaluations_ + 2 < max_evaluations && gained_ > 1) {
          if (!evaluate(r_, &J_).ok()) break;
          fresh = true;
          gained_ = 0;
          continue;
        }
        if (damping < 1e-3 || expected <= 0 || shortened) break;
        damping /= 10;
        continue;
      }
      slow_ = squares > data_.wanted && expected < hopeless * (squares - data_.wanted) ? slow_ + 1 : 0;
      if (slow_ > patience) break;
      move_to(trial);
      Eigen::VectorXd r;
      Eigen::MatrixXd J;
      const Status status = evaluate(r, secant ? nullptr : &J);
      const double now = status.ok() ? r.squaredNorm() : std::numeric_limits<double>::infinity();
      if (now < squares) {
        const double agreement = (squares - now) / expected;
        if (secant) {
          const double length = moved.squaredNorm();
          if (length > 0) J_ += (r - r_ - linear) * moved.transpose() / length;
          fresh = false;
        } else {
          J_.swap(J);
        }
        gained_ += squares - now;
        shortened = false;
        x_ = trial;
        r_.swap(r);
        squares = now;
        if (creeps(squares)) break;
        damping *= std::max(1.0 / 3, 1 - std::pow(2 * agreement - 1, 3));
        damping = std::max(damping, 1e-12);
        growth = 2;
        continue;
      }
      if (secant && !fresh) {
        move_to(x_);
        if (!evaluate(r_, &J_).ok()) break;
        fresh = true;
      }
      damping *= growth;
      growth *= 2;
      if (damping > 1e12) break;
    }
    move_to(x_);
    fit.free = free_;
    fit.chi2 = squares;
    fit.residuals = r_;
    fit.jacobian = J_;
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      fit.at_bound.push_back(x_[k] <= 1e-6 || x_[k] >= 1 - 1e-6);
      fit.jacobian.col(k) /= slope(k);
    }
    fit.evaluations = evaluations_;
    return fit;
  }

 private:
  void move_to(const Eigen::VectorXd& x) {
    for (std::size_t k = 0; k < variables_.size(); ++k) unit_[variables_[k].front()] = x[static_cast<Eigen::Index>(k)];
    std::vector<double>& mapped = mapped_;
    mapped.resize(unit_.size());
    assembly_.box().from_unit(unit_, mapped);
    for (const Variable& variable : variables_)
      for (const std::size_t member : variable) free_[member] = mapped[variable.front()];
  }

  /// d value/d unit coordinate of a variable where it is.
  [[nodiscard]] double slope(Eigen::Index k) const {
    const auto& parameter = assembly_.layout().parameters[variables_[static_cast<std::size_t>(k)].front()];
    const double value = free_[variables_[static_cast<std::size_t>(k)].front()];
    return parameter.scale == Scale::log ? value * std::log(parameter.max / parameter.min)
                                         : parameter.max - parameter.min;
  }

  /// Whether the last steps together gained almost nothing, as on the floor of a valley that the data leave open.
  bool creeps(double squares) {
    passed_.push_back(squares);
    // With a misfit of k times the noise, a gain k² times as large is insignificant, up to what a comparison of fits
    // resolves.
    constexpr double decides = 0.5;
    const double large = std::max(squares / static_cast<double>(r_.size()), 1.0);
    const double negligible = std::max(data_.negligible, std::min(data_.negligible * large, decides));
    return passed_.size() > creep && passed_[passed_.size() - 1 - creep] - squares < negligible;
  }

  Status evaluate(Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    evaluations_ += J != nullptr && !assembly_.layout().jacobian_is_exact ? 2 : 1;
    Eigen::MatrixXd all;
    Status status = whitened(assembly_, free_, workspace_, r, J ? &all : nullptr);
    if (!status.ok()) return status;
    if (data_.added) r += *data_.added;
    const auto left_out = [this](Eigen::Index i) {
      return data_.counted && !(*data_.counted)[static_cast<std::size_t>(i)];
    };
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (left_out(i)) r[i] = 0;
    if (!J) return status;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (left_out(i)) all.row(i).setZero();
    J->setZero(r.size(), x_.size());
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      for (const std::size_t member : variables_[static_cast<std::size_t>(k)])
        J->col(k) += all.col(static_cast<Eigen::Index>(member));
      J->col(k) *= slope(k);
    }
    return status;
  }

  const assembly::Assembly& assembly_;
  const std::vector<Variable>& variables_;
  assembly::Workspace& workspace_;
  const DataVariant data_;
  std::vector<double> free_, unit_, mapped_;
  Eigen::VectorXd x_, r_;
  Eigen::MatrixXd J_;
  std::size_t evaluations_ = 0;
  double gained_ = 0;
  int slow_ = 0;                ///< steps in a row that promise too little
  std::vector<double> passed_;  ///< |r|² after every step down
};

}  // namespace

Status whitened(const assembly::Assembly& assembly, std::span<const double> free, assembly::Workspace& workspace,
                Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
  const auto rows = static_cast<Eigen::Index>(assembly.layout().residual_count);
  const auto columns = static_cast<Eigen::Index>(free.size());
  residuals.resize(rows);
  double objective = 0;
  RowMajor J;
  if (jacobian) J.resize(rows, columns);
  Status status = assembly.evaluator().evaluate(free, objective, {}, {residuals.data(), static_cast<std::size_t>(rows)},
                                                {J.data(), static_cast<std::size_t>(J.size())}, workspace);
  if (status.ok() && jacobian) *jacobian = J;
  return status;
}

Fit least_squares(const assembly::Assembly& assembly, const std::vector<Variable>& variables,
                  std::span<const double> start, assembly::Workspace& workspace, std::size_t max_evaluations,
                  const DataVariant& data) {
  return Descent(assembly, variables, start, workspace, data).run(max_evaluations);
}

std::vector<Variable> all_variables(const assembly::Assembly& assembly) {
  std::vector<Variable> variables;
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) variables.push_back({j});
  return variables;
}

Eigen::MatrixXd interior(const Fit& fit) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (!fit.at_bound[static_cast<std::size_t>(k)]) free.push_back(k);
  return fit.jacobian(Eigen::all, free);
}

bool at_a_bound(const Fit& fit) {
  return std::find(fit.at_bound.begin(), fit.at_bound.end(), true) != fit.at_bound.end();
}

}  // namespace tunica::diagnosis
