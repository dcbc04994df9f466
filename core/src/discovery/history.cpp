// SPDX-License-Identifier: Apache-2.0
#include "discovery/history.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/evidence/projection.hpp"
#include "numerics/distributions.hpp"

namespace tunica::discovery {
namespace {

using diagnosis::Curve;

constexpr int common_degree = 6, own_degree = 2;  ///< of Legendre polynomials

/// Rows of one curve in which the abscissa goes one way.
struct Branch {
  const Curve* curve;
  std::vector<Eigen::Index> rows;  ///< of the residuals
  std::vector<double> abscissa;
  bool rises = true;
};

/// The branches of a curve along its path; a change of direction by less than a twentieth of the range is none.
std::vector<Branch> branches_of(const Curve& curve, const std::vector<double>& path) {
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  const double turn = 0.05 * (*high - *low);
  std::vector<Branch> all{{&curve, {}, {}, true}};
  double extreme = path.front();
  bool known = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double x = path[i];
    Branch* now = &all.back();
    if (!known && std::abs(x - extreme) > turn) {
      now->rises = x > extreme;
      known = true;
      extreme = x;
    } else if (known && (now->rises ? extreme - x : x - extreme) > turn) {
      all.push_back({&curve, {}, {}, !now->rises});
      now = &all.back();
      extreme = x;
    } else if (known) {
      extreme = now->rises ? std::max(extreme, x) : std::min(extreme, x);
    }
    now->rows.push_back(curve.first + static_cast<Eigen::Index>(i));
    now->abscissa.push_back(x);
  }
  return all;
}

/// An abscissa over the fitted rows of a curve.
struct Course {
  std::string name;
  std::vector<double> values;
  [[nodiscard]] bool held() const {
    return std::all_of(values.begin(), values.end(), [this](double x) { return x == values.front(); });
  }
};

/// The abscissae of a curve, but for time.
std::vector<Course> courses_of(const diagnosis::Evidence& evidence, const Curve& curve) {
  std::vector<Course> all;
  const auto add = [&all](const std::string& name, std::vector<double> values) {
    if (!name.starts_with("time")) all.push_back({name, std::move(values)});
  };
  for (const assembly::MeasuredChannel& view : evidence.base->layout().channels) {
    if (view.test != curve.test || view.observable != curve.channel) continue;
    add(fmt::format("{} [{}]", view.abscissa_name, view.abscissa_unit), curve.abscissa);
    for (const auto& [name, values] : view.other_abscissae) {
      std::vector<double> fitted;
      for (const std::size_t row : curve.rows) fitted.push_back(values[row]);
      add(name, std::move(fitted));
    }
  }
  return all;
}

/// The one that varies. None where two do: rows at one value of the first are then different strains.
std::optional<Course> path_of(const std::vector<Course>& courses) {
  std::optional<Course> path;
  for (const Course& course : courses) {
    if (course.held()) continue;
    if (path) return std::nullopt;
    path = course;
  }
  return path;
}

/// Everything about a test that an energy sees, beside the path: what two tests have to share.
std::string sight_of(const diagnosis::Evidence& evidence, const Curve& curve, const std::vector<Course>& courses) {
  const experiment::TestEntry& test = evidence.experiment.test(curve.test);
  std::string sight = test.type + "|" + curve.channel;
  for (const auto& [name, value] : test.options.values())
    sight += "|" + name + "=" + std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
  for (const auto& [name, setting] : test.parameters)
    sight += fmt::format("|{}={}", name, setting.fixed.value_or(setting.initial.value_or(0)));
  // A second stretch that is held is part of the strain.
  for (const Course& course : courses)
    sight += course.held() ? fmt::format("|{}={:.6g}", course.name, course.values.front()) : "|" + course.name;
  for (const experiment::LayerEntry& layer : test.layers) sight += "|" + layer.model;
  return sight;
}

double legendre(int degree, double t) { return std::legendre(static_cast<unsigned>(degree), std::clamp(t, -1.0, 1.0)); }

/// Columns along the abscissa over the rows of these branches.
Eigen::MatrixXd columns(const std::vector<const Branch*>& branches, double low, double high, int degree,
                        Eigen::Index rows) {
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(rows, degree + 1);
  for (const Branch* branch : branches)
    for (std::size_t i = 0; i < branch->rows.size(); ++i)
      for (int d = 0; d <= degree; ++d)
        shapes(branch->rows[i], d) = legendre(d, 2 * (branch->abscissa[i] - low) / (high - low) - 1);
  return shapes;
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

}  // namespace

PathDependence path_dependence(const diagnosis::Evidence& evidence, const diagnosis::Fit& fit) {
  std::map<std::string, std::vector<Branch>> alike;
  for (const Curve& curve : evidence.curves) {
    const std::vector<Course> courses = courses_of(evidence, curve);
    const std::optional<Course> path = path_of(courses);
    if (!path) continue;
    for (Branch& branch : branches_of(curve, path->values))
      if (branch.rows.size() > 3) alike[sight_of(evidence, curve, courses)].push_back(std::move(branch));
  }
  const Eigen::VectorXd& r = fit.residuals;
  PathDependence found;
  Eigen::Index freedom = 0;
  double worst = 0;
  for (const auto& [sight, branches] : alike) {
    if (branches.size() < 2) continue;
    double low = INFINITY, high = -INFINITY;
    std::vector<const Branch*> all;
    for (const Branch& branch : branches) {
      all.push_back(&branch);
      const auto [least, most] = std::minmax_element(branch.abscissa.begin(), branch.abscissa.end());
      low = std::min(low, *least);
      high = std::max(high, *most);
    }
    if (!(high > low)) continue;
    const Eigen::MatrixXd common = columns(all, low, high, common_degree, r.size());
    Eigen::MatrixXd each = common;
    for (const Branch& branch : branches) each = beside(each, columns({&branch}, low, high, own_degree, r.size()));
    const diagnosis::Projection of_common(common), of_each(each);
    const double gain = of_common.off(r).squaredNorm() - of_each.off(r).squaredNorm();
    found.chi2 += gain;
    freedom += of_each.rank() - of_common.rank();
    if (gain <= worst) continue;
    worst = gain;
    found.branches = std::any_of(branches.begin(), branches.end(), [&branches = branches](const Branch& one) {
      return one.curve == branches.front().curve && &one != &branches.front();
    });
    found.where = found.branches ? fmt::format("loading and unloading in the test '{}'", branches.front().curve->test)
                                 : fmt::format("the tests '{}' and '{}', which are alike in all that an energy sees",
                                               branches.front().curve->test, branches.back().curve->test);
  }
  if (freedom == 0) return found;
  found.p_value = numerics::chi_squared_above(found.chi2, static_cast<double>(freedom));
  const double misfit = fit.chi2 - static_cast<double>(r.size());
  found.share = misfit > 0 ? std::min((found.chi2 - static_cast<double>(freedom)) / misfit, 1.0) : 0;
  return found;
}

}  // namespace tunica::discovery
