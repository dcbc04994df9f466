// SPDX-License-Identifier: Apache-2.0
#include "population/simulated.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include <Eigen/Cholesky>
#include <fmt/format.h>

namespace simulated {
namespace {

Eigen::VectorXd logs(std::initializer_list<double> values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  Eigen::Index k = 0;
  for (const double value : values) result[k++] = std::log(value);
  return result;
}

void exponential_at(const Eigen::VectorXd& xi, Eigen::VectorXd& y, Eigen::MatrixXd& J) {
  const double a = std::exp(xi[0]), b = std::exp(xi[1]);
  for (Eigen::Index i = 0; i < 20; ++i) {
    const double e = 0.4 * static_cast<double>(i + 1) / 20, grown = std::exp(b * e);
    y[i] = a * (grown - 1);
    J.row(i) << y[i], a * b * e * grown;
  }
}

void strip_at(const Eigen::VectorXd& xi, Eigen::VectorXd& y, Eigen::MatrixXd& J) {
  const double mu = std::exp(xi[0]), k1 = std::exp(xi[1]), k2 = std::exp(xi[2]);
  for (Eigen::Index i = 0; i < 25; ++i) {
    const double l = 1 + 0.35 * static_cast<double>(i + 1) / 25, e = l * l - 1;
    const double matrix = mu * (l - 1 / (l * l)), fibre = 2 * k1 * l * e * std::exp(k2 * e * e);
    y[i] = matrix + fibre;
    J.row(i) << matrix, fibre, fibre * k2 * e * e;
  }
}

void sheet_at(const Eigen::VectorXd& xi, Eigen::VectorXd& y, Eigen::MatrixXd& J) {
  const double c = std::exp(xi[0]), c1 = std::exp(xi[1]), c2 = std::exp(xi[2]), c3 = std::exp(xi[3]);
  const double mu = std::exp(xi[4]);
  constexpr double ratios[3][2] = {{1, 1}, {1, 0.5}, {0.5, 1}};
  for (Eigen::Index k = 0; k < 36; ++k) {
    const double strain = 0.3 * static_cast<double>(k % 12 + 1) / 12;
    const double t = 1 + strain * ratios[k / 12][0], z = 1 + strain * ratios[k / 12][1];
    const double et = (t * t - 1) / 2, ez = (z * z - 1) / 2;
    const double grown = std::exp(c1 * et * et + c2 * ez * ez + 2 * c3 * et * ez);
    const double by_q[3] = {c1 * et * et, c2 * ez * ez, 2 * c3 * et * ez};
    const auto put = [&](Eigen::Index row, double l, double other, double own, double e, double cross, double across,
                         Eigen::Index first) {
      const double fibre = c * (own * e + cross) * l * grown, matrix = mu * (l - 1 / (l * l * l * other * other));
      y[row] = fibre + matrix;
      J.row(row) << fibre, fibre * by_q[0], fibre * by_q[1], fibre * by_q[2] + c * across * l * grown, matrix;
      J(row, first) += c * own * e * l * grown;
    };
    put(k, t, z, c1, et, c3 * ez, c3 * ez, 1);
    put(36 + k, z, t, c2, ez, c3 * et, c3 * et, 2);
  }
}

}  // namespace

const Curve& exponential() {
  static const Curve curve{{"a", "b"}, {20}, exponential_at, logs({10, 6}), {2}};
  return curve;
}

const Curve& strip() {
  static const Curve curve{{"mu", "k1", "k2"}, {25}, strip_at, logs({8, 5, 1.5}), {0.4}};
  return curve;
}

const Curve& precise_strip() {
  static const Curve curve{{"mu", "k1", "k2"}, {25}, strip_at, logs({8, 5, 1.5}), {0.1}};
  return curve;
}

const Curve& sheet() {
  static const Curve curve{{"c", "c1", "c2", "c3", "mu"}, {36, 36}, sheet_at, logs({10, 4, 3, 1.5, 2}), {0.6, 0.6}};
  return curve;
}

double Normal::operator()() {
  for (;;) {
    const double u = 2 * uniform() - 1, v = 2 * uniform() - 1, s = u * u + v * v;
    if (s > 0 && s < 1) return u * std::sqrt(-2 * std::log(s) / s);
  }
}

Eigen::VectorXd Normal::vector(Eigen::Index size) {
  Eigen::VectorXd result(size);
  for (Eigen::Index j = 0; j < size; ++j) result[j] = (*this)();
  return result;
}

std::optional<Expansion> Measured::expand(std::size_t specimen, const Prior& prior) const {
  const Eigen::Index p = prior.mean.size(), n = y[specimen].size();
  Eigen::VectorXd values(n);
  Eigen::MatrixXd J(n, p);
  Eigen::VectorXd weights(n);
  Eigen::Index row = 0;
  for (std::size_t c = 0; c < curve->rows.size(); ++c)
    for (std::size_t k = 0; k < curve->rows[c]; ++k)
      weights[row++] = 1 / (prior.variances[c] * curve->noise[c] * curve->noise[c]);
  const auto objective = [&](const Eigen::VectorXd& xi) {
    curve->evaluate(xi, values, J);
    const Eigen::VectorXd r = values - y[specimen], d = xi - prior.mean;
    return r.dot(weights.cwiseProduct(r)) + d.dot(prior.precision * d);
  };
  Eigen::VectorXd xi = prior.mean;
  double value = objective(xi), damping = 1e-3;
  for (int k = 0; k < 200; ++k) {
    objective(xi);
    const Eigen::MatrixXd H = J.transpose() * weights.asDiagonal() * J + prior.precision;
    const Eigen::VectorXd g =
        J.transpose() * weights.cwiseProduct(values - y[specimen]) + prior.precision * (xi - prior.mean);
    const Eigen::MatrixXd damped = H + damping * Eigen::MatrixXd(H.diagonal().asDiagonal());
    const Eigen::VectorXd step = -damped.ldlt().solve(g);
    const double next = step.norm() < 5 ? objective(xi + step) : HUGE_VAL;
    if (!(next <= value)) {
      damping *= 10;
      if (damping > 1e12) break;
      continue;
    }
    xi += step;
    value = next;
    damping = std::max(damping / 10, 1e-12);
    if (step.norm() < 1e-9) break;
  }
  objective(xi);
  Expansion result{xi, {}, 0};
  row = 0;
  for (std::size_t c = 0; c < curve->rows.size(); ++c) {
    const auto count = static_cast<Eigen::Index>(curve->rows[c]);
    const Eigen::MatrixXd own = J.middleRows(row, count) / curve->noise[c];
    const Eigen::VectorXd r = (values - y[specimen]).segment(row, count) / curve->noise[c];
    result.channels.push_back(
        {own.transpose() * own, own.transpose() * r, r.squaredNorm(), static_cast<double>(count)});
    result.normalisation +=
        static_cast<double>(count) * std::log(2 * std::numbers::pi * curve->noise[c] * curve->noise[c]);
    row += count;
  }
  return result;
}

Eigen::VectorXd Measured::misfits(std::size_t specimen, const Eigen::MatrixXd& points,
                                  const std::vector<double>& variances) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(points.cols()), values(y[specimen].size());
  Eigen::MatrixXd J(values.size(), points.rows());
  for (Eigen::Index s = 0; s < points.cols(); ++s) {
    curve->evaluate(points.col(s), values, J);
    Eigen::Index row = 0;
    for (std::size_t c = 0; c < curve->rows.size(); ++c) {
      const auto count = static_cast<Eigen::Index>(curve->rows[c]);
      result[s] +=
          (values - y[specimen]).segment(row, count).squaredNorm() / (variances[c] * curve->noise[c] * curve->noise[c]);
      row += count;
    }
  }
  return result;
}

Cohort cohort_of(const Measured& measured) {
  Cohort result;
  for (const std::string& name : measured.curve->parameters) result.parameters.push_back({name, true, 1});
  for (std::size_t i = 0; i < measured.y.size(); ++i) result.specimens.push_back({fmt::format("s{:03}", i), {}, 0});
  for (std::size_t c = 0; c < measured.curve->rows.size(); ++c)
    result.channels.push_back({fmt::format("c{}", c), true});
  result.start = measured.curve->typical;
  result.expand = [measured](std::size_t i, const Prior& prior) { return measured.expand(i, prior); };
  result.misfits = [measured](std::size_t i, const Eigen::MatrixXd& points, const std::vector<double>& variances) {
    return measured.misfits(i, points, variances);
  };
  return result;
}

Cohort cohort(const Curve& curve, const std::vector<Eigen::VectorXd>& xi, Normal& normal) {
  Measured measured{&curve, {}};
  for (const Eigen::VectorXd& own : xi) {
    Eigen::Index n = 0;
    for (const std::size_t rows : curve.rows) n += static_cast<Eigen::Index>(rows);
    Eigen::VectorXd y(n);
    Eigen::MatrixXd J(n, own.size());
    curve.evaluate(own, y, J);
    Eigen::Index row = 0;
    for (std::size_t c = 0; c < curve.rows.size(); ++c)
      for (std::size_t k = 0; k < curve.rows[c]; ++k) y[row++] += curve.noise[c] * normal();
    measured.y.push_back(y);
  }
  return cohort_of(measured);
}

Cohort linear(const std::vector<Eigen::VectorXd>& values, const std::vector<Eigen::MatrixXd>& informations) {
  Cohort result;
  const Eigen::Index p = values.front().size();
  for (Eigen::Index j = 0; j < p; ++j) result.parameters.push_back({fmt::format("p{}", j), false, 1});
  for (std::size_t i = 0; i < values.size(); ++i) result.specimens.push_back({fmt::format("s{:03}", i), {}, 0});
  result.channels.push_back({"known", false});
  result.start = Eigen::VectorXd::Zero(p);
  result.expand = [=](std::size_t i, const Prior&) -> std::optional<Expansion> {
    return Expansion{values[i], {{informations[i], Eigen::VectorXd::Zero(p), 0, static_cast<double>(p)}}, 0};
  };
  return result;
}

}  // namespace simulated
