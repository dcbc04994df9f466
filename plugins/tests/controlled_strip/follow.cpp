// SPDX-License-Identifier: Apache-2.0
#include "follow.hpp"

#include <cmath>

namespace tunica::controlled_strip {
namespace {

/// The value of a channel, and its derivative from those of σ, l and y.
///
///     stress = σ e^{−kl},   λ1 = e^l,   λ2 = e^{y/2},   λ3 = e^{−l−y/2}
struct Reading {
  double value, by_stress, by_l, by_y;
};
Reading read(Channel channel, Control measure, double stress, Place at) {
  switch (channel) {
    case Channel::stretch: {
      const double stretch = std::exp(at.l);
      return {stretch, 0, stretch, 0};
    }
    case Channel::transverse_stretch: {
      const double stretch = std::exp(at.y / 2);
      return {stretch, 0, 0, stretch / 2};
    }
    case Channel::normal_stretch: {
      const double stretch = std::exp(-at.l - at.y / 2);
      return {stretch, 0, -stretch, -stretch / 2};
    }
    case Channel::stress:
      break;
  }
  const double k = power(measure), factor = std::exp(-k * at.l);
  return {stress * factor, factor, -k * stress * factor, 0};
}

/// The steps of one call.
class Walk {
 public:
  Walk(const Strip& strip, const TestInput& input, const TestOutput& output)
      : strip_(strip),
        output_(output),
        count_(input.model_parameters.size()),
        parameters_(!output.jacobian.empty()),
        point_(input.model, input.model_parameters, strip.loaded, strip.timed, parameters_) {
    const std::size_t carried = parameters_ ? count_ : 0;
    start_dp_.assign(carried, 0.0);
    l_dp_ = y_dp_ = stress_dp_ = start_dp_;
  }

  bool begin() { return point_.begin(); }
  [[nodiscard]] const std::string& failure() const { return point_.failure(); }

  bool step(const LoadStep& step, double time_step) {
    if (step.begins) start_of_segment(step.control);
    wanted_ = step.fixed + step.of_start * start_;
    if (step.control == Control::stretch && !(wanted_ > 0)) return false;
    if (!find_equilibrium(point_, step.control, wanted_, time_step, at_, parameters_)) return false;
    const Slope f = controlled(step.control, point_, at_), r = point_.lateral();
    determinant_ = f.by_l * r.by_y - f.by_y * r.by_l;
    if (parameters_) differentiate(step, f, r);
    if (step.row != LoadStep::none) write(step.row, r);
    stress_ = point_.stress().value;
    point_.accept(l_dp_, y_dp_);
    return true;
  }
  [[nodiscard]] double wanted() const { return wanted_; }

 private:
  /// What the quantity is now, with its derivatives by the parameters.
  void start_of_segment(Control control) {
    const double k = power(control), factor = std::exp(-k * at_.l);
    const bool stretch = control == Control::stretch;
    start_ = stretch ? std::exp(at_.l) : stress_ * factor;
    for (std::size_t j = 0; j < start_dp_.size(); ++j)
      start_dp_[j] = stretch ? start_ * l_dp_[j] : (stress_dp_[j] - k * stress_ * l_dp_[j]) * factor;
  }

  /// Total derivatives of l, y and σ: f(l, y; p) = v(p), r(l, y; p) = 0.
  void differentiate(const LoadStep& step, const Slope& f, const Slope& r) {
    const double factor = std::exp(-power(step.control) * at_.l);
    for (std::size_t j = 0; j < count_; ++j) {
      const double own = step.control == Control::stretch ? 0 : point_.stress_by(j) * factor;
      const double f_p = own - step.of_start * start_dp_[j], r_p = point_.lateral_by(j);
      l_dp_[j] = -(f_p * r.by_y - f.by_y * r_p) / determinant_;
      y_dp_[j] = -(f.by_l * r_p - r.by_l * f_p) / determinant_;
      stress_dp_[j] = point_.stress_by(j) + point_.stress().by_l * l_dp_[j] + point_.stress().by_y * y_dp_[j];
    }
  }

  void write(std::size_t row, const Slope& r) {
    const std::size_t n = strip_.rows, size = strip_.channels.size() * n;
    const Slope& stress = point_.stress();
    // By the prescribed value: f moves by one, r stays 0.
    const double l_v = r.by_y / determinant_, y_v = -r.by_l / determinant_;
    for (std::size_t k = 0; k < strip_.channels.size(); ++k) {
      const Reading reading = read(strip_.channels[k], strip_.measure, stress.value, at_);
      const std::size_t place = k * n + row;
      if (!output_.values.empty()) output_.values[place] = reading.value;
      if (!output_.abscissa_derivative.empty())
        output_.abscissa_derivative[place] =
            reading.by_stress * (stress.by_l * l_v + stress.by_y * y_v) + reading.by_l * l_v + reading.by_y * y_v;
      for (std::size_t j = 0; parameters_ && j < count_; ++j)
        output_.jacobian[j * size + place] =
            reading.by_stress * stress_dp_[j] + reading.by_l * l_dp_[j] + reading.by_y * y_dp_[j];
    }
    if (output_.diagnostics.empty()) return;
    output_.diagnostics[row] = std::exp(at_.y / 2);
    output_.diagnostics[n + row] = std::exp(-at_.l - at_.y / 2);
  }

  const Strip& strip_;
  const TestOutput& output_;
  std::size_t count_;
  bool parameters_;
  StripPoint point_;
  Place at_;
  double start_ = 0, stress_ = 0, wanted_ = 0, determinant_ = 1;
  std::vector<double> start_dp_, l_dp_, y_dp_, stress_dp_;
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
  if (!output.abscissa_derivative.empty() && input.model.describe().history_size > 0)
    return Status::failed(begin + "no derivative by the abscissa along the path of a model with history");
  Walk walk(strip, input, output);
  if (!walk.begin()) return Status::failed(begin + "the model fails at rest: " + walk.failure());
  double before = 0;
  for (const LoadStep& step : steps) {
    if (!walk.step(step, std::max(0.0, step.time - before)))
      return Status::failed(begin + "no equilibrium at " + step_name(step, walk.wanted()) +
                            (walk.failure().empty() ? ": the material does not bear the load, or its energy overflows"
                                                    : ": " + walk.failure()));
    before = step.time;
  }
  return {};
}

}  // namespace tunica::controlled_strip
