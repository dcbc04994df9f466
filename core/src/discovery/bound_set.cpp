// SPDX-License-Identifier: Apache-2.0
#include "discovery/bound_set.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tunica::discovery {
namespace {

using experiment::ParameterSetting;
using experiment::ParameterSettings;
using Json = nlohmann::ordered_json;

/// Ranges and first values of the parameters of a term, whose names begin with `prefix`.
void set_ranges(const Kind& kind, const std::string& prefix, ParameterSettings& settings) {
  const auto amplitude = [&](const std::string& name) {
    ParameterSetting& setting = settings[prefix + name];
    setting.scale = Scale::linear;
    if (kind.largest > 0) setting.max = kind.largest;
    if (kind.is_product()) setting.min = 0;
    if (kind.invariant == "stretches") {
      setting.min = kind.negative ? (kind.largest < 0 ? kind.largest : -5000) : 0;
      if (kind.negative) setting.max = 0;
    }
    const double edge = kind.negative ? *setting.min : setting.max.value_or(1);
    setting.initial = 0.01 * edge;
  };
  amplitude(kind.amplitude());
  for (const std::string& height : kind.heights) amplitude(height);
  for (const Shape& shape : kind.shapes) {
    ParameterSetting& setting = settings[prefix + shape.name];
    setting.scale = shape.scale;
    setting.min = shape.low;
    setting.max = shape.high;
    setting.initial = shape.starts.front();
  }
}

/// An entry of "terms" of `composed`.
Json term_json(const Kind& kind, const std::string& name) {
  Json term = {{"name", name}, {"invariant", kind.invariant}};
  if (kind.invariant != "stretches") term["law"] = kind.law;
  if (!kind.family.empty()) term["family"] = kind.family;
  if (!kind.knots.empty()) term["knots"] = kind.knots;
  return term;
}

}  // namespace

std::vector<std::string> first_terms(bool changes_volume) {
  if (changes_volume) return {"I1bar_linear", "J_quadratic"};
  return {"I1_linear"};
}

experiment::Experiment with_first_terms(experiment::Experiment experiment, const std::string& model,
                                        bool changes_volume, const plugins::Catalogue::Entry<ModelFactory>& writer) {
  Json terms = Json::array();
  for (const std::string& name : first_terms(changes_volume)) {
    const auto line = name.find('_');
    terms.push_back({{"name", name}, {"invariant", name.substr(0, line)}, {"law", name.substr(line + 1)}});
  }
  for (auto& entry : experiment.models) {
    if (entry.name != model) continue;
    entry.type = writer.factory.type;
    entry.options = {};
    entry.options.set("terms", terms.dump());
    entry.parameters.clear();
    entry.mechanisms.clear();
  }
  return experiment;
}

std::size_t index_of(const assembly::Assembly& assembly, const Subject& subject, const std::string& term,
                     const std::string& name) {
  const auto id = subject.from_nothing ? assembly::of_model(subject.model, "", term + "_" + name)
                                       : assembly::of_model(subject.model, term, name);
  if (const auto index = assembly.layout().index_of(id)) return *index;
  throw std::logic_error(fmt::format("the term '{}' has no free parameter '{}'", term, name));
}

BoundSet::BoundSet(const Subject& subject, const std::vector<KindPointer>& kinds) : experiment_(subject.experiment) {
  auto& models = experiment_.models;
  auto& model =
      *std::find_if(models.begin(), models.end(), [&](const auto& entry) { return entry.name == subject.model; });
  Json list = Json::array();
  if (subject.from_nothing) {
    model.parameters.clear();
    model.mechanisms.clear();
  }
  for (const KindPointer& kind : kinds) {
    BoundTerm term{kind->name, 0, {}, {}};
    const auto taken = [&] {
      return std::any_of(terms_.begin(), terms_.end(), [&](const BoundTerm& other) { return other.name == term.name; });
    };
    for (int copy = 2; taken(); ++copy) term.name = fmt::format("{}_{}", kind->name, copy);
    if (subject.from_nothing) {
      list.push_back(term_json(*kind, term.name));
      set_ranges(*kind, term.name + "_", model.parameters);
    } else {
      experiment::MechanismEntry entry{subject.catalogue.term_mechanism()->factory.id, kind->options(), {}, term.name};
      set_ranges(*kind, "", entry.parameters);
      model.mechanisms.push_back(std::move(entry));
    }
    terms_.push_back(std::move(term));
  }
  if (subject.from_nothing) {
    model.type = subject.catalogue.term_model()->factory.type;
    model.options = {};
    model.options.set("terms", list.dump());
  }
  assembly_ = std::make_unique<assembly::Assembly>(experiment_, subject.run, subject.catalogue);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const auto index = [&](const std::string& name) { return index_of(*assembly_, subject, terms_[k].name, name); };
    terms_[k].amplitude = index(kinds[k]->amplitude());
    for (const std::string& height : kinds[k]->heights) terms_[k].heights.push_back(index(height));
    for (const Shape& shape : kinds[k]->shapes) terms_[k].shapes.push_back(index(shape.name));
  }
}

}  // namespace tunica::discovery
