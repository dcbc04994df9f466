// SPDX-License-Identifier: Apache-2.0
#include "material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tunica::fe {
namespace {

/// Every part is a function of an invariant without I2: then W depends on the diagonal of C alone while C_tz = C_tr =
/// 0.
bool linear_in_C(const Model& model, std::span<const double> parameters) {
  if (!model.describe().principal_axes || model.parts().empty()) return false;
  return std::ranges::all_of(model.parts(), [&](const auto& part) {
    Invariant x;
    part->invariant(parameters, x, {});
    return x.i2 == 0;
  });
}

/// The outputs of a call, including unused ones.
struct Scratch {
  std::vector<double> tensors, stress, tangent, stress_dp, gradient_dp, time_steps;
  std::vector<double> opened, C, energy, first, second, first_dp;
};

Scratch& scratch() {
  thread_local Scratch mine;
  return mine;
}

/// (a, b) of the ten second derivatives, among tt, zz, rr and s.
constexpr std::array<std::array<std::size_t, 2>, Material::seconds> pairs{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}, {3, 3}, {0, 3}, {1, 3}, {2, 3}}};

}  // namespace

Material::Material(const Model& model, std::span<const double> parameters)
    : layers_{{&model, 0, parameters, linear_in_C(model, parameters), 0, 0}},
      parameters_(parameters),
      sees_shear_(!layers_.front().diagonal) {}

Material::Material(std::span<const Model* const> models, std::span<const double> parameters,
                   std::span<const std::size_t> columns, const Closing* closing)
    : parameters_(parameters), closing_(closing) {
  std::size_t first = 0;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const auto own = parameters.subspan(first, models[k]->describe().parameters.size());
    layers_.push_back({models[k], first, own, linear_in_C(*models[k], own), lanes_, lanes_ + columns[k]});
    first += own.size();
    lanes_ += columns[k];
    sees_shear_ |= !layers_.back().diagonal;
  }
}

Status Material::evaluate(std::size_t n, std::span<const double> C, std::span<double> first, std::span<double> second,
                          std::span<double> first_dp, std::size_t row) const {
  const Call call{n, C, {}, first, second, first_dp, {}, {}};
  if (plain() && !remembers()) return respond(layers_.front(), call);
  return in_layers(call, row);
}

Status Material::energy(std::size_t n, std::span<const double> C, std::span<double> energy) const {
  const Call call{n, C, energy, {}, {}, {}, {}, {}};
  if (plain()) return on_tensors(layers_.front(), call);
  return in_layers(call, 0);
}

Status Material::evaluate_layer(std::size_t layer, std::size_t n, std::span<const double> C,
                                std::span<double> first) const {
  return respond(layers_[layer], {n, C, {}, first, {}, {}, {}, {}});
}

Status Material::remember(std::size_t n, std::span<const double> C, std::size_t row) const {
  if (history_->after.size() <= row) history_->after.resize(row + 1);
  std::size_t size = 0;
  for (const Layer& layer : layers_)
    size +=
        layer.model->describe().history_size * (lanes_ == 0 ? n : n / lanes_ * (layer.last_lane - layer.first_lane));
  history_->after[row].resize(size);
  return in_layers({n, C, {}, {}, {}, {}, {}, history_->after[row]}, row);
}

/// C from the sector, C₀ = F₀ᵀ C F₀.
void Material::open(std::size_t n, std::span<const double> C, std::span<double> opened) const {
  for (std::size_t i = 0; i < n; ++i) {
    const double square = closing_->square[i];
    opened[i] = C[i] * square;
    opened[n + i] = C[n + i];
    opened[2 * n + i] = C[2 * n + i] / square;
    opened[3 * n + i] = C[3 * n + i] / std::sqrt(square);
  }
}

/// Derivatives by C from those by C₀, and the factors of layers.
void Material::close(const Call& call) const {
  const std::size_t n = call.n, components = sees_shear_ ? 4 : 3;
  for (std::size_t i = 0; i < n; ++i) {
    const double factor = closing_->factored ? closing_->factor[i] : 1;
    const double square = closing_->opened ? closing_->square[i] : 1;
    const std::array<double, firsts> by{square, 1, 1 / square, 1 / std::sqrt(square)};
    if (!call.energy.empty()) call.energy[i] *= factor;
    for (std::size_t a = 0; a < (call.first.empty() ? 0 : components); ++a) call.first[a * n + i] *= factor * by[a];
    for (std::size_t k = 0; k < (call.second.empty() ? 0 : sees_shear_ ? seconds : 6); ++k)
      call.second[k * n + i] *= factor * by[pairs[k][0]] * by[pairs[k][1]];
    for (std::size_t j = 0; j < (call.first_dp.empty() ? 0 : parameter_count()); ++j)
      for (std::size_t a = 0; a < components; ++a) call.first_dp[(4 * j + a) * n + i] *= factor * by[a];
  }
}

/// The points of each layer are gathered for one call of its model, and its results are scattered back.
Status Material::in_layers(const Call& call, std::size_t row) const {
  const std::size_t n = call.n, lanes = lanes_ == 0 ? n : lanes_, groups = n / lanes;
  Scratch& my = scratch();
  std::span<const double> C = call.C;
  if (closing_ != nullptr && closing_->opened) {
    my.opened.resize(4 * n);
    open(n, call.C, my.opened);
    C = my.opened;
  }
  std::fill(call.first_dp.begin(), call.first_dp.end(), 0.0);
  std::size_t state_begin = 0;
  for (const Layer& layer : layers_) {
    const std::size_t from = lanes_ == 0 ? 0 : layer.first_lane,
                      width = lanes_ == 0 ? n : layer.last_lane - layer.first_lane, m = groups * width,
                      count = call.first_dp.empty() ? 0 : layer.parameters.size(),
                      state = layer.model->describe().history_size * m;
    const auto copy = [&](std::span<const double> source, std::size_t source_n, std::size_t source_from,
                          std::span<double> to, std::size_t to_n, std::size_t to_from, std::size_t components) {
      const std::size_t source_lanes = source_n / groups, to_lanes = to_n / groups;
      for (std::size_t k = 0; k < components; ++k)
        for (std::size_t g = 0; g < groups; ++g)
          std::copy_n(&source[k * source_n + g * source_lanes + source_from], width,
                      &to[k * to_n + g * to_lanes + to_from]);
    };
    my.C.resize(4 * m);
    my.energy.resize(call.energy.empty() ? 0 : m);
    // A layer that does not see shear leaves these zero.
    my.first.assign(call.first.empty() ? 0 : 4 * m, 0);
    my.second.assign(call.second.empty() ? 0 : 10 * m, 0);
    my.first_dp.resize(4 * count * m);
    copy(C, n, from, my.C, m, 0, 4);
    Call own{m, my.C, my.energy, my.first, my.second, my.first_dp, {}, {}};
    if (history_ != nullptr && state > 0) {
      if (history_->before.size() > row) own.old_state = std::span(history_->before[row]).subspan(state_begin, state);
      if (!call.new_state.empty()) own.new_state = call.new_state.subspan(state_begin, state);
      state_begin += state;
    }
    if (Status status = respond(layer, own); !status.ok()) return status;
    if (!call.energy.empty()) copy(my.energy, m, 0, call.energy, n, from, 1);
    if (!call.first.empty()) copy(my.first, m, 0, call.first, n, from, 4);
    if (!call.second.empty()) copy(my.second, m, 0, call.second, n, from, 10);
    if (count > 0) copy(my.first_dp, m, 0, call.first_dp.subspan(4 * layer.first_parameter * n), n, from, 4 * count);
  }
  if (closing_ != nullptr && !closing_->none()) close(call);
  return {};
}

Status Material::respond(const Layer& layer, const Call& call) const {
  if (!layer.diagonal || !call.energy.empty()) return on_tensors(layer, call);
  const std::size_t n = call.n, count = layer.parameters.size();
  if (call.first.empty() && call.second.empty() && call.first_dp.empty()) return {};
  std::vector<double>& by = scratch().gradient_dp;
  if (!call.first_dp.empty()) by.resize(3 * count * n);
  Status status = layer.model->evaluate_axes({n, call.C.first(3 * n), layer.parameters},
                                             {{},
                                              call.first.empty() ? call.first : call.first.first(3 * n),
                                              call.second.empty() ? call.second : call.second.first(6 * n),
                                              call.first_dp.empty() ? std::span<double>() : std::span(by)});
  for (std::size_t j = 0; j < (call.first_dp.empty() ? 0 : count); ++j) {
    std::copy_n(by.begin() + static_cast<std::ptrdiff_t>(3 * j * n), 3 * n,
                call.first_dp.begin() + static_cast<std::ptrdiff_t>(4 * j * n));
    std::fill_n(call.first_dp.begin() + static_cast<std::ptrdiff_t>((4 * j + 3) * n), n, 0.0);
  }
  return status;
}

Status Material::on_tensors(const Layer& layer, const Call& call) const {
  const std::size_t n = call.n, parameters = call.first_dp.empty() ? 0 : layer.parameters.size();
  Scratch& my = scratch();
  my.tensors.assign(6 * n, 0);
  my.stress.resize(call.first.empty() ? 0 : 6 * n);
  my.tangent.resize(call.second.empty() ? 0 : 36 * n);
  my.stress_dp.resize(6 * parameters * n);
  std::copy_n(call.C.begin(), 3 * n, my.tensors.begin());
  std::copy_n(call.C.begin() + static_cast<std::ptrdiff_t>(3 * n), n,
              my.tensors.begin() + static_cast<std::ptrdiff_t>(4 * n));
  const bool timed = history_ != nullptr && history_->timed && layer.model->describe().history_size > 0;
  my.time_steps.assign(timed ? n : 0, timed ? history_->time_step : 0);
  Status status = layer.model->evaluate({n, my.tensors, layer.parameters, my.time_steps, call.old_state},
                                        {call.energy, my.stress, my.tangent, my.stress_dp, call.new_state});
  if (!status.ok()) return status;

  // δW = ½ S : δC: ∂W/∂C_aa = S_aa/2 on the diagonal, ∂W/∂s = S_zr
  constexpr std::array<std::size_t, firsts> component{0, 1, 2, 4};
  constexpr std::array<double, firsts> factor{0.5, 0.5, 0.5, 1};
  const auto take = [&](std::span<const double> from, std::span<double> to) {
    for (std::size_t a = 0; a < firsts; ++a)
      for (std::size_t i = 0; i < n; ++i) to[a * n + i] = factor[a] * from[component[a] * n + i];
  };
  if (!call.first.empty()) take(my.stress, call.first);
  for (std::size_t j = 0; j < parameters; ++j)
    take(std::span(my.stress_dp).subspan(6 * j * n, 6 * n), call.first_dp.subspan(4 * j * n, 4 * n));
  // with A = 2 ∂S/∂C in tensor components: ∂²W/∂C_aa∂C_bb = A_aabb/4, ∂²W/∂C_aa∂s = A_aazr/2, ∂²W/∂s² = A_zrzr
  for (std::size_t k = 0; k < (call.second.empty() ? 0 : seconds); ++k) {
    const auto [a, b] = pairs[k];
    const double* const above = &my.tangent[(6 * component[a] + component[b]) * n];
    const double* const below = &my.tangent[(6 * component[b] + component[a]) * n];
    // Memory of a deviator is not quite symmetric where the volume changes: Newton's matrix takes the mean.
    const bool memory = history_ != nullptr;
    for (std::size_t i = 0; i < n; ++i)
      call.second[k * n + i] = factor[a] * factor[b] * (memory ? 0.5 * (above[i] + below[i]) : above[i]);
  }
  return {};
}

}  // namespace tunica::fe
