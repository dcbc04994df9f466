// SPDX-License-Identifier: Apache-2.0
#include "discover/fitting.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "discover/set_at.hpp"

namespace tunica::trial {
namespace {

diagnosis::Evidence evidence_of(const Rubber& rubber, const ToFit& what) {
  experiment::Experiment read = rubber.read();
  if (what.from_nothing)
    read = discovery::with_first_terms(std::move(read), "rubber", false, *testing::catalogue().term_model());
  const diagnosis::Request request = diagnosis::request_of(read);
  const diagnosis::Progress silent;
  return diagnosis::evidence_of({read, request, testing::catalogue(), silent}, {});
}

}  // namespace

MeasuredRubber::MeasuredRubber(const ToFit& what) {
  for (Strip& strip : strips) {
    strip.sd = what.sd;
    strip.stretch.erase(strip.stretch.begin(), strip.stretch.end() - static_cast<std::ptrdiff_t>(what.rows));
    std::string text = "stretch [1],stress [kPa]\n";
    for (const double stretch : strip.stretch) text += fmt::format("{},0\n", stretch);
    folder.write(strip.name + ".csv", text);
  }
  if (what.with) what.with(experiment);
  measure(what.seed, what.hide);
}

FittedRubber::FittedRubber(const ToFit& what)
    : rubber(what),
      evidence(evidence_of(rubber, what)),
      subject{evidence.experiment, evidence.run, "rubber", what.from_nothing, testing::catalogue()},
      fitter(subject, evidence) {}

discovery::KindPointer FittedRubber::kind(const std::string& name,
                                          const std::function<void(discovery::Kind&)>& change) const {
  for (discovery::Kind& one : discovery::kinds_of({}, states(), true))
    if (one.name == name) {
      one.largest = fitter.largest_amplitude(one);
      if (change) change(one);
      return std::make_shared<const discovery::Kind>(one);
    }
  throw std::out_of_range(name);
}

discovery::SetFit FittedRubber::at(const std::vector<discovery::KindPointer>& kinds,
                                   const std::vector<double>& free) const {
  return set_at(subject, kinds, free);
}

double FittedRubber::measured() const {
  double sum = 0;
  for (const assembly::MeasuredChannel& view : evidence.base->layout().channels)
    for (std::size_t i = 0; i < view.count; ++i) sum += std::pow(view.measured[i] / view.noise->absolute, 2);
  return std::sqrt(sum);
}

std::size_t index_named(const assembly::Assembly& assembly, const std::string& name) {
  const auto& parameters = assembly.layout().parameters;
  const auto found = std::ranges::find(parameters, name, &assembly::FreeParameter::name);
  if (found == parameters.end()) throw std::logic_error("no free parameter is called '" + name + "'");
  return static_cast<std::size_t>(found - parameters.begin());
}

std::size_t place_of(const discovery::SetFit& fit, const std::string& parameter) {
  return index_named(fit.set->assembly(), parameter);
}

Measured::Hide hidden(const std::string& invariant, const std::string& law,
                      const std::vector<std::pair<std::string, double>>& parameters, const std::string& family) {
  nlohmann::json term = {{"invariant", invariant}, {"law", law}};
  if (!family.empty()) term["family"] = family;
  for (const auto& [name, value] : parameters) term["parameters"][name]["initial"] = value;
  return hidden_term(term);
}

}  // namespace tunica::trial
