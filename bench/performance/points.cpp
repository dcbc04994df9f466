// SPDX-License-Identifier: Apache-2.0
// Material points: one call of Model::evaluate_axes for a batch on a biaxial path, at the parameters' initial values.
#include <cmath>
#include <map>

#include "energies.hpp"
#include "rows.hpp"
#include "tools.hpp"

namespace tunica::bench {
namespace {

enum class Call { energy, gradient, hessian, parameters };
const std::vector<std::pair<Call, std::string>> calls{{Call::energy, "energy"},
                                                      {Call::gradient, "gradient"},
                                                      {Call::hessian, "hessian"},
                                                      {Call::parameters, "parameters"}};

/// What a model and its floor read and write. The same memory for both: where it lies in the cache decides for neither.
struct Memory {
  std::size_t n;
  std::vector<double> p, c, energy, gradient, hessian, dp;

  Memory(std::size_t points, std::vector<double> parameters)
      : n(points),
        p(std::move(parameters)),
        c(3 * n),
        energy(n),
        gradient(3 * n),
        hessian(6 * n),
        dp(3 * n * p.size()) {
    for (std::size_t i = 0; i < n; ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(n), t = 1 + 0.48 * share,
                   z = 1 + 0.24 * share;
      c[i] = t * t;
      c[n + i] = z * z;
      c[2 * n + i] = 1 / (t * t * z * z);
    }
  }
  [[nodiscard]] AxisResponse response(Call call) {
    switch (call) {
      case Call::energy:
        return {energy, {}, {}, {}, {}};
      case Call::gradient:
        return {{}, gradient, {}, {}, {}};
      case Call::hessian:
        return {{}, gradient, hessian, {}, {}};
      case Call::parameters:
        break;
    }
    return {{}, gradient, hessian, dp, {}};
  }
  [[nodiscard]] floors::Points floor(Call call) {
    return {n,
            c.data(),
            call == Call::energy ? energy.data() : nullptr,
            call == Call::energy ? nullptr : gradient.data(),
            call >= Call::hessian ? hessian.data() : nullptr,
            call == Call::parameters ? dp.data() : nullptr};
  }
  /// The outputs that a call writes, one behind the other.
  [[nodiscard]] std::vector<double> written(Call call) const {
    std::vector<double> all = call == Call::energy ? energy : gradient;
    if (call >= Call::hessian) all.insert(all.end(), hessian.begin(), hessian.end());
    if (call == Call::parameters) all.insert(all.end(), dp.begin(), dp.end());
    return all;
  }
};

/// The order of the floor's parameters (mu, k1, k2, shapes) in that of the model.
std::vector<double> reordered(const std::vector<double>& model, std::size_t n, std::size_t shapes) {
  std::vector<double> floor(model.size());
  const auto copy = [&](std::size_t from, std::size_t to) {
    std::copy_n(model.begin() + static_cast<std::ptrdiff_t>(3 * n * from), 3 * n,
                floor.begin() + static_cast<std::ptrdiff_t>(3 * n * to));
  };
  copy(0, 0);
  copy(shapes, 1);  // mu, the shapes but theta, k1, k2, theta
  copy(shapes + 1, 2);
  for (std::size_t j = 0; j + 1 < shapes; ++j) copy(1 + j, 3 + j);
  copy(shapes + 2, 2 + shapes);
  return floor;
}

Prepared prepare(const std::string& type, Call call, std::size_t n) {
  const auto model = std::shared_ptr<Model>(make_model(type));
  std::vector<double> p;
  for (const Parameter& parameter : model->describe().parameters) p.push_back(parameter.initial);
  const auto memory = std::make_shared<Memory>(n, p);
  const auto response = memory->response(call);
  Prepared prepared;
  prepared.work = {[model, memory, response, n] {
                     check(model->evaluate_axes({n, memory->c, memory->p}, response));
                   },
                   static_cast<double>(n)};
  prepared.work.call();
  std::vector<double> own = memory->written(call);
  for (const double value : own)
    if (!std::isfinite(value)) throw std::runtime_error(type + " is not finite on the path");
  const auto energy = fibre_energy(type == "gho_parts" || type == "gho_joint" ? "gho" : type, p);
  if (!energy) return prepared;
  for (const floors::Kernels* const kernels : levels())
    prepared.floors.push_back(
        {"fused kernel",
         kernels->level,
         {[kernels, memory, energy = *energy, at = memory->floor(call)] { kernels->points(energy, at); },
          static_cast<double>(n)}});
  prepared.floors.front().work.call();
  if (call == Call::parameters) {
    const auto begin = own.begin() + static_cast<std::ptrdiff_t>(9 * n);
    const auto dp = reordered({begin, own.end()}, n, energy->shapes);
    std::copy(dp.begin(), dp.end(), begin);
  }
  prepared.facts.emplace_back("floor_differs", difference(own, memory->written(call)));
  return prepared;
}

}  // namespace

std::vector<Row> point_rows() {
  std::vector<Row> rows;
  for (const char* type :
       {"neo_hooke", "mooney_rivlin", "yeoh", "gent", "ogden", "arruda_boyce", "hgo", "gho", "holzapfel_2015",
        "four_fibre", "holzapfel_ogden", "fung", "hyperfoam", "composed", "gho_parts", "gho_joint"})
    for (const auto& [call, word] : calls) {
      const std::string what = call == Call::energy     ? "energy"
                               : call == Call::gradient ? "gradient"
                               : call == Call::hessian  ? "gradient and Hessian"
                                                        : "gradient, Hessian, parameter derivatives";
      rows.push_back({std::string("point/") + type + "/" + word,
                      what,
                      "point",
                      "points",
                      {40, 8, 320},
                      [type = std::string(type), call = call](std::size_t n) { return prepare(type, call, n); }});
    }
  return rows;
}

}  // namespace tunica::bench
