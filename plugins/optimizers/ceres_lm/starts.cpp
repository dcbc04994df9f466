// SPDX-License-Identifier: Apache-2.0
#include "starts.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/sobol.hpp>

namespace tunica::ceres_lm {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

 private:
  boost::random::mt19937_64 engine_;
};

std::vector<double> latin_hypercube(std::size_t count, std::size_t n, Random& random) {
  std::vector<double> points(count * n);
  std::vector<std::size_t> interval(count);
  for (std::size_t j = 0; j < n; ++j) {
    std::iota(interval.begin(), interval.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) std::swap(interval[i - 1], interval[random.below(i)]);
    for (std::size_t i = 0; i < count; ++i) {
      points[i * n + j] = (static_cast<double>(interval[i]) + random.uniform()) / static_cast<double>(count);
    }
  }
  return points;
}

std::vector<double> shifted_sobol(std::size_t count, std::size_t n, Random& random) {
  std::vector<double> points(count * n), shift(n);
  for (double& value : shift) value = random.uniform();
  boost::random::sobol sequence(n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = static_cast<double>(sequence() >> 11) * 0x1p-53 + shift[i % n];
    points[i] = value - std::floor(value);
  }
  return points;
}

}  // namespace

std::vector<double> spread_points(Sampling sampling, std::size_t count, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return sampling == Sampling::sobol ? shifted_sobol(count, n, random) : latin_hypercube(count, n, random);
}

}  // namespace tunica::ceres_lm
