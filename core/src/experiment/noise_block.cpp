// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "experiment/blocks.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

Block<data::Noise> noise_block(const std::string& channel, const std::string& unit) {
  const std::string owner = fmt::format("the noise of '{}'", channel);
  const auto not_negative = [](const char* kind) {
    return [kind](const Node& node, double value) {
      if (value < 0) node.fail(fmt::format("the {} noise is {}", kind, value), "A standard deviation is not negative.");
    };
  };
  const auto read_correlation = [](const Node& node) {
    const double correlation = node.number("a correlation");
    if (!(correlation > -1 && correlation < 1))
      node.fail(fmt::format("the correlation {} is not between -1 and 1", correlation),
                "Correct it, or leave it out where rows err independently.");
    return correlation;
  };
  return {owner,
          "σ² = absolute² + (relative·y)².",
          {quantity_key("absolute", "Standard deviation in the channel's unit.", &data::Noise::absolute, unit, owner,
                        not_negative("absolute")),
           quantity_key("relative", "Standard deviation as a share of the value.", &data::Noise::relative, "1",
                        "a relative noise", not_negative("relative")),
           member_key(
               "correlation", [] { return number_schema("Between neighbouring rows.", -1, 1); },
               &data::Noise::correlation, read_correlation)}};
}

data::Noise read_noise_of(const Node& node, const Observable& channel) {
  data::Noise noise;
  noise_block(channel.name, channel.unit).read(node, noise);
  if (!(noise.absolute > 0 || noise.relative > 0))
    node.fail(fmt::format("the noise of '{}' is zero", channel.name),
              "Give \"absolute\" or \"relative\" greater than zero, or leave \"noise\" out to have it estimated.");
  return noise;
}

const Observable& observable_of(const std::vector<Observable>& observables, std::string_view name) {
  return *data::quantity_named(name, observables)->observable;
}

// Either one noise for every channel, or an object of channels.
void read_noise(const Node& node, const std::vector<Observable>& observables, data::DataRequest& data) {
  std::vector<std::string> mapped;
  for (const auto& [name, column] : data.columns)
    if (const Observable& channel = observable_of(observables, name); channel.role == Observable::Role::channel)
      mapped.push_back(channel.name);
  if (mapped.empty())
    node.fail("\"noise\" changes nothing: no measured quantity is mapped",
              "Map one in \"columns\", or leave the noise out.");
  const auto members =
      node.members("a noise, {\"absolute\": …, \"relative\": …, \"correlation\": …}, or one per channel,");
  const bool per_channel = !members.empty() && std::all_of(members.begin(), members.end(), [](const auto& member) {
    return member.second.is_object();
  });
  if (!per_channel) {
    for (const std::string& name : mapped)
      data.noise.emplace_back(name, read_noise_of(node, observable_of(observables, name)));
    return;
  }
  for (const auto& [name, child] : members) {
    if (std::find(mapped.begin(), mapped.end(), name) == mapped.end())
      child.fail(fmt::format("noise is given for '{}', which is not a mapped channel", excerpt(name)),
                 suggestion(name, mapped));
    data.noise.emplace_back(name, read_noise_of(child, observable_of(observables, name)));
  }
}

}  // namespace

Json noise_schema() { return noise_block("", "").schema(); }

Key<data::DataRequest> noise_key(const std::vector<Observable>& observables) {
  const auto schema = [&observables] {
    Json per_channel = Json::object();
    for (const Observable& observable : observables)
      if (observable.role == Observable::Role::channel) per_channel[observable.name] = reference("noise");
    Json either = {{"description",
                    "Standard deviation of the data: one for all channels, or one per channel; absent = estimated."}};
    either["anyOf"] = Json::array({reference("noise"), object_schema("By channel.", std::move(per_channel))});
    return either;
  };
  return {"noise", schema,
          [&observables](const Node& node, data::DataRequest& data) { read_noise(node, observables, data); },
          [](const data::DataRequest& data) {
            Json json;
            for (const auto& [channel, noise] : data.noise) json[channel] = noise_block("", "").write(noise);
            return json;
          }};
}

}  // namespace tunica::experiment
