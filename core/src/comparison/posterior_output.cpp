// SPDX-License-Identifier: Apache-2.0
#include "comparison/posterior_output.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/unlisted_prior.hpp"
#include "comparison/fit_table.hpp"
#include "execution/files.hpp"
#include "experiment/limits.hpp"
#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

using execution::WarningKind;
using posterior::Chain;
using posterior::Posterior;

constexpr std::size_t most_draws = experiment::limits::draws;
constexpr double shifted_limit = 0.5;  ///< of the linearised half width

/// [[chain 1], [chain 2], …]
std::string by_chain(const Posterior& made, const std::function<double(const Chain&, std::size_t)>& value) {
  std::string text = "[";
  for (const Chain& chain : made.chains) {
    text += text.size() > 1 ? ",\n[" : "[";
    for (std::size_t draw = 0; draw < chain.draws(); ++draw)
      text += fmt::format("{}{}", draw > 0 ? "," : "", value(chain, draw));
    text += ']';
  }
  return text + ']';
}

void say(RunSummary& summary, std::string sentence) { summary.uncertainty.push_back(std::move(sentence)); }

/// Whether quantiles of the parameter can be read.
bool is_settled(const posterior::Convergence& found) {
  return found.r_hat <= posterior::largest_r_hat && std::min(found.bulk, found.tail) >= posterior::least_effective_size;
}

void warn_of_short_chains(const Posterior& made, const RunSummary& summary, std::vector<execution::Warning>& warnings) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < made.parameters.size(); ++j)
    if (!is_settled(made.parameters[j].convergence)) names.push_back(summary.parameters[j].name);
  if (names.empty()) return;
  // As effective sizes grow with the draws, more of them would not do.
  const bool hopeless = made.effective_size() * static_cast<double>(most_draws) <
                        posterior::least_effective_size * static_cast<double>(made.draws());
  const std::string cure =
      hopeless ? fmt::format("More draws will hardly do, since the data leave a long valley; fix one of {}",
                             text::joined(names))
               : fmt::format("Draw more with --posterior={}", std::min(4 * made.draws(), most_draws));
  warnings.push_back(
      {WarningKind::posterior_not_converged,
       fmt::format("the chains of the posterior are too short for {}: R-hat is {:.3f} (at most {:g}), the effective "
                   "sample size {:.0f} (at least {:g}), so quantiles are rough. {}",
                   text::joined(names), made.r_hat(), posterior::largest_r_hat, made.effective_size(),
                   posterior::least_effective_size, cure),
       summary.label, names});
}

void warn_of_disagreement(const Posterior& made, RunSummary& summary, std::vector<execution::Warning>& warnings) {
  if (!made.converged()) return;  // rough quantiles judge nothing
  std::vector<std::string> names;
  for (std::size_t j = 0; j < made.parameters.size(); ++j) {
    const Estimate& estimate = summary.parameters[j];
    if (!estimate.ci95) continue;
    const auto& found = made.parameters[j];
    const double allowed = shifted_limit * (estimate.ci95->second - estimate.ci95->first) / 2;
    if (std::abs(found.lower - estimate.ci95->first) <= allowed &&
        std::abs(found.upper - estimate.ci95->second) <= allowed)
      continue;
    names.push_back(estimate.name);
    say(summary, fmt::format("{}: the posterior ({:.4g} … {:.4g}) and the linearised interval ({:.4g} … {:.4g}) "
                             "disagree: the likelihood is not quadratic there, or a bound or prior cuts it off",
                             estimate.name, found.lower, found.upper, estimate.ci95->first, estimate.ci95->second));
  }
  if (names.empty()) return;
  warnings.push_back({WarningKind::posterior_disagrees,
                      fmt::format("the posterior and the linearised {} of {} disagree. Take the posterior",
                                  names.size() == 1 ? "interval" : "intervals", text::joined(names)),
                      summary.label, names});
}

}  // namespace

void add_posterior(const assembly::Assembly& assembly, const Posterior& made, RunSummary& summary,
                   std::vector<execution::Warning>& warnings) {
  PosteriorSummary found;
  found.chains = made.chains.size();
  found.draws = made.draws();
  found.warm_up = posterior::warm_up * found.chains;
  found.evaluations = made.evaluations;
  found.failures = made.failures;
  for (const Chain& chain : made.chains)
    found.acceptance += std::accumulate(chain.acceptance.begin(), chain.acceptance.end(), 0.0);
  found.acceptance /= static_cast<double>(found.draws);
  found.r_hat = made.r_hat();
  found.effective_size = made.effective_size();
  found.converged = made.converged();
  found.factor_known = made.factor_known;
  found.held_out_rows = made.bands.held_out.rows;
  found.held_out_inside = made.bands.held_out.inside;
  if (const auto& misfit = made.bands.misfit)
    found.discrepancy = {misfit->lower, misfit->median, misfit->upper, misfit->none};
  summary.posterior = found;
  for (std::size_t j = 0; j < made.parameters.size(); ++j) {
    const auto& one = made.parameters[j];
    summary.parameters[j].posterior = PosteriorMarginal{one.mean,
                                                        one.sd,
                                                        one.lower,
                                                        one.median,
                                                        one.upper,
                                                        one.convergence.r_hat,
                                                        one.convergence.bulk,
                                                        one.convergence.tail};
  }
  summary.posterior_lower = made.bands.lower;
  summary.posterior_median = made.bands.median;
  summary.posterior_upper = made.bands.upper;
  summary.measured_lower = made.bands.lowest_measured;
  summary.measured_upper = made.bands.highest_measured;
  warn_of_short_chains(made, summary, warnings);
  warn_of_disagreement(made, summary, warnings);
  if (const auto& misfit = found.discrepancy)
    say(summary,
        fmt::format("the posterior allows for a smooth misfit beside the model: its size is {:.2g} % of the range of a "
                    "channel ({:.2g} … {:.2g} %), and there is none with a probability of {:.2g}",
                    100 * misfit->median, 100 * misfit->lower, 100 * misfit->upper, misfit->none));
  if (found.discrepancy && found.discrepancy->upper >= assembly::unlisted::sizes.back())
    say(summary,
        "no larger misfit than that is allowed for: the model misses the data in kind, and bands of measurements may "
        "be "
        "too narrow. Take another model");
  if (made.factor_assumed)
    warnings.push_back({WarningKind::posterior_noise_assumed,
                        "the posterior takes the noise for known though not all of it is stated: the shapes of a "
                        "misfit and the parameters follow every fitted row, and leave nothing to estimate it from. "
                        "State \"noise\", fit more rows, or leave out --discrepancy, or \"discrepancy\" in the file",
                        summary.label,
                        {}});
  if (!made.factor_known)
    say(summary,
        "the posterior takes one common factor of all noise for unknown, as the linearised intervals do: "
        "noise that is not stated, or that χ² contradicts, is no more than estimated");
  const auto& channels = assembly.layout().channels;
  const bool weighted = std::any_of(channels.begin(), channels.end(),
                                    [](const auto& view) { return view.weight > 0 && view.weight != 1; });
  if (summary.objective_type != "least_squares" || weighted)
    say(summary,
        "the objective is not least squares with weights of 1, and no likelihood: the posterior is that of the "
        "noise, so its centre may differ from the best point");
  if (made.failures > 0)
    say(summary, fmt::format("{} of {} simulations of the posterior failed; it takes their parameters for impossible",
                             made.failures, made.evaluations));
  if (found.held_out_rows > 0)
    say(summary, fmt::format("{} of {} held-out rows lie within the 95 % band of measurements of the posterior",
                             found.held_out_inside, found.held_out_rows));
}

std::string write_posterior(const std::filesystem::path& directory, const assembly::Assembly& assembly,
                            const Posterior& made, const std::string& label) {
  const auto name = [](const std::string& text) { return nlohmann::json(text).dump(); };
  std::string text = "{\"posterior\": {";
  for (std::size_t j = 0; j < made.parameters.size(); ++j)
    text += fmt::format("{}\n{}: {}", j > 0 ? "," : "", name(assembly.layout().parameters[j].name),
                        by_chain(made, [j](const Chain& chain, std::size_t draw) { return chain.value(draw, j); }));
  text += fmt::format("}},\n\"sample_stats\": {{\n\"lp\": {},\n\"acceptance_rate\": {}}}}}\n",
                      by_chain(made, [](const Chain& chain, std::size_t draw) { return chain.log_density[draw]; }),
                      by_chain(made, [](const Chain& chain, std::size_t draw) { return chain.acceptance[draw]; }));
  const std::string file = "posterior_" + file_stem(label) + ".json";
  execution::write_atomically(directory / file, text);
  return file;
}

}  // namespace tunica::comparison
