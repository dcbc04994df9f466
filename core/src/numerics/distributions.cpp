// SPDX-License-Identifier: Apache-2.0
#include "numerics/distributions.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace tunica::numerics {

namespace math = boost::math;

double normal_quantile(double probability) { return math::quantile(math::normal(), probability); }

double student_quantile(double probability, double freedom) {
  return math::quantile(math::students_t(freedom), probability);
}

double student_above(double x, double freedom) { return math::cdf(math::complement(math::students_t(freedom), x)); }

double noncentral_student_above(double x, double freedom, double noncentrality) {
  return math::cdf(math::complement(math::non_central_t(freedom, noncentrality), x));
}

double chi_squared_quantile(double probability, double freedom) {
  return math::quantile(math::chi_squared(freedom), probability);
}

double chi_squared_below(double x, double freedom) { return math::cdf(math::chi_squared(freedom), x); }

double chi_squared_above(double x, double freedom) {
  return math::cdf(math::complement(math::chi_squared(freedom), x));
}

double noncentrality_at(double x, double freedom, double probability) {
  return math::non_central_chi_squared_distribution<double>::find_non_centrality(freedom, x, probability);
}

double f_below(double x, double freedom, double freedom_below) {
  return math::cdf(math::fisher_f(freedom, freedom_below), x);
}

double f_above(double x, double freedom, double freedom_below) {
  return math::cdf(math::complement(math::fisher_f(freedom, freedom_below), x));
}

double binomial_at_least(std::size_t successes, std::size_t trials, double probability) {
  if (successes == 0) return 1;
  const math::binomial_distribution<> distribution(static_cast<double>(trials), probability);
  return math::cdf(math::complement(distribution, static_cast<double>(successes - 1)));
}

}  // namespace tunica::numerics
