// SPDX-License-Identifier: Apache-2.0
#include "follow.hpp"

#include <cmath>

namespace tunica::controlled_strip {
namespace {

/// The value of a channel, and its derivative from those of σ, the measured l = ln λ1, and of what the material feels:
/// f = ln λ1 and y, with q = ln p, p the growth of the rest length.
///
///     stress = σ e^{−k(f+q)},   λ1 = e^l,   λ2 = e^{(y−q)/2},   λ3 = e^{−f−(y+q)/2}
struct Reading {
  double value, by_stress, by_l, by_f, by_y, by_q;
};
struct Felt {
  double f, y, q;
};
Reading read(Channel channel, Control measure, double stress, double l, const Felt& felt) {
  switch (channel) {
    case Channel::stretch: {
      const double stretch = std::exp(l);
      return {stretch, 0, stretch, 0, 0, 0};
    }
    case Channel::transverse_stretch: {
      const double stretch = std::exp((felt.y - felt.q) / 2);
      return {stretch, 0, 0, 0, stretch / 2, -stretch / 2};
    }
    case Channel::normal_stretch: {
      const double stretch = std::exp(-felt.f - (felt.y + felt.q) / 2);
      return {stretch, 0, 0, -stretch, -stretch / 2, -stretch / 2};
    }
    case Channel::stress:
      break;
  }
  const double k = power(measure), factor = std::exp(-k * (felt.f + felt.q));
  return {stress * factor, factor, 0, -k * stress * factor, 0, -k * stress * factor};
}

/// The steps of one call. Parameters are those of the model, then the permanent set where the test has it.
class Walk {
 public:
  Walk(const Strip& strip, const TestInput& input, const TestOutput& output)
      : strip_(strip),
        output_(output),
        set_(input.model_parameters.size()),
        count_(set_ + (strip.has_set ? 1 : 0)),
        parameters_(!output.jacobian.empty()),
        point_(input.model, input.model_parameters, strip.loaded, strip.timed, parameters_, count_ - set_) {
    if (strip.has_set) rest_.s = input.test_parameters[0];
    start_dp_.assign(parameters_ ? count_ : 0, 0.0);
    felt_dp_ = l_dp_ = y_dp_ = stress_dp_ = largest_dp_ = start_dp_;
  }

  bool begin() { return point_.begin(); }
  [[nodiscard]] const std::string& failure() const { return point_.failure(); }
  [[nodiscard]] double wanted() const { return wanted_; }

  bool step(const LoadStep& step, double time_step) {
    if (step.begins) start_of_segment(step.control);
    wanted_ = step.fixed + step.of_start * start_;
    const bool by_stretch = step.control == Control::stretch;
    if (by_stretch && !(wanted_ > 0)) return false;
    const RestLength::Felt given_felt = by_stretch ? rest_.felt(wanted_) : RestLength::Felt{};
    if (!find_equilibrium(point_, rest_, step.control, by_stretch ? given_felt.stretch : wanted_, time_step, at_,
                          parameters_))
      return false;
    const Slope f = controlled(step.control, point_, rest_, at_), r = point_.lateral();
    determinant_ = f.by_l * r.by_y - f.by_y * r.by_l;
    const RestLength::Measured measured = rest_.measured(at_.l);
    l_ = by_stretch ? std::log(wanted_) : measured.l;
    stress_ = given_felt.slack ? 0 : point_.stress().value;
    for (std::size_t j = 0; parameters_ && j < count_; ++j) {
      const double s = j == set_ ? 1 : 0, given = step.of_start * start_dp_[j];
      double f_p;
      if (by_stretch) {
        f_p = -(given_felt.by_measured * given + given_felt.by_s * s + given_felt.by_largest * largest_dp_[j]);
      } else {
        const double k = power(step.control), moved = measured.by_s * s + measured.by_largest * largest_dp_[j];
        f_p = (point_.stress_by(j) - k * stress_ * moved) * std::exp(-k * l_) - given;
      }
      differentiate(j, f_p, f, r);
      l_dp_[j] = by_stretch ? given / wanted_
                            : measured.by_felt * felt_dp_[j] + measured.by_s * s + measured.by_largest * largest_dp_[j];
      if (given_felt.slack) stress_dp_[j] = 0;
    }
    if (const double stretch = std::exp(l_); stretch > rest_.largest) {
      rest_.largest = stretch;
      for (std::size_t j = 0; parameters_ && j < count_; ++j) largest_dp_[j] = stretch * l_dp_[j];
    }
    if (step.row != LoadStep::none) write(step.row, r);
    point_.accept(felt_dp_, y_dp_);
    return true;
  }

 private:
  /// The present value of the quantity, with its derivatives by the parameters.
  void start_of_segment(Control control) {
    const bool stretch = control == Control::stretch;
    const Reading now = read(stretch ? Channel::stretch : Channel::stress, control, stress_, l_, felt());
    start_ = now.value;
    for (std::size_t j = 0; j < start_dp_.size(); ++j) start_dp_[j] = total(now, j);
  }
  [[nodiscard]] Felt felt() const { return {at_.l, at_.y, std::log(rest_.ratio())}; }
  [[nodiscard]] double total(const Reading& of, std::size_t j) const {
    const double q = (rest_.s * largest_dp_[j] + (j == set_ ? rest_.largest - 1 : 0)) / rest_.ratio();
    return of.by_stress * stress_dp_[j] + of.by_l * l_dp_[j] + of.by_f * felt_dp_[j] + of.by_y * y_dp_[j] + of.by_q * q;
  }

  /// Total derivatives of the felt l, y and σ: f(l, y; p) = v(p), r(l, y; p) = 0.
  void differentiate(std::size_t j, double f_p, const Slope& f, const Slope& r) {
    const double r_p = point_.lateral_by(j);
    felt_dp_[j] = -(f_p * r.by_y - f.by_y * r_p) / determinant_;
    y_dp_[j] = -(f.by_l * r_p - r.by_l * f_p) / determinant_;
    stress_dp_[j] = point_.stress_by(j) + point_.stress().by_l * felt_dp_[j] + point_.stress().by_y * y_dp_[j];
  }

  void write(std::size_t row, const Slope& r) {
    const std::size_t n = strip_.rows, size = strip_.channels.size() * n;
    const Slope& stress = point_.stress();
    // By the prescribed value: f moves by one, r stays 0.
    const double l_v = r.by_y / determinant_, y_v = -r.by_l / determinant_;
    for (std::size_t k = 0; k < strip_.channels.size(); ++k) {
      const Reading reading = read(strip_.channels[k], strip_.measure, stress_, l_, felt());
      const std::size_t at = k * n + row;
      if (!output_.values.empty()) output_.values[at] = reading.value;
      if (!output_.abscissa_derivative.empty())
        output_.abscissa_derivative[at] = reading.by_stress * (stress.by_l * l_v + stress.by_y * y_v) +
                                          (reading.by_l + reading.by_f) * l_v + reading.by_y * y_v;
      for (std::size_t j = 0; parameters_ && j < count_; ++j) output_.jacobian[j * size + at] = total(reading, j);
    }
    if (output_.diagnostics.empty()) return;
    output_.diagnostics[row] = read(Channel::transverse_stretch, strip_.measure, stress_, l_, felt()).value;
    output_.diagnostics[n + row] = read(Channel::normal_stretch, strip_.measure, stress_, l_, felt()).value;
  }

  const Strip& strip_;
  const TestOutput& output_;
  std::size_t set_, count_;  ///< place of the permanent set; parameters
  bool parameters_;
  StripPoint point_;
  RestLength rest_;
  Place at_;                               ///< what the material feels
  double l_ = 0, stress_ = 0, start_ = 0;  ///< ln λ1 as measured; σ; where the segment began
  double wanted_ = 0, determinant_ = 1;
  std::vector<double> start_dp_, felt_dp_, l_dp_, y_dp_, stress_dp_, largest_dp_;
};

}  // namespace

std::string step_name(const LoadStep& step, double value) {
  const std::string what = step.control == Control::stretch ? "stretch " : "stress ";
  const std::string where =
      step.row == LoadStep::none ? "time " + std::to_string(step.time) + " s" : "row " + std::to_string(step.row + 1);
  return where + " (" + what + std::to_string(value) + (step.control == Control::stretch ? ")" : " kPa)");
}

Status follow(const Strip& strip, std::span<const LoadStep> steps, const TestInput& input, const TestOutput& output) {
  const std::string begin = std::string(strip.type) + ": ";
  if (!output.jacobian.empty() && !StripPoint::can_be_followed(input.model))
    return Status::failed(begin + "no exact Jacobian of a model without principal axes; difference the predictions");
  if (!output.abscissa_derivative.empty() && (strip.has_set || input.model.describe().history_size > 0))
    return Status::failed(begin + "no derivative by the abscissa along the path of a model with history");
  Walk walk(strip, input, output);
  if (!walk.begin()) return Status::failed(begin + "the model fails at rest: " + walk.failure());
  double before = 0;
  for (const LoadStep& step : steps) {
    if (!walk.step(step, strip.time_factor * std::max(0.0, step.time - before)))
      return Status::failed(begin + "no equilibrium at " + step_name(step, walk.wanted()) +
                            (walk.failure().empty() ? ": the material does not bear the load, or its energy overflows"
                                                    : ": " + walk.failure()));
    before = step.time;
  }
  return {};
}

}  // namespace tunica::controlled_strip
