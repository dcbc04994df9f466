// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "assembly/noise.hpp"
#include "text/codes.hpp"

namespace tunica::assembly {

/// The source of a channel's σ.
enum class NoiseOrigin { stated, replicates, smooth_shapes, assumed };

inline constexpr text::Codes<NoiseOrigin, 4> noise_origin_codes{{
    {NoiseOrigin::stated, "stated"},
    {NoiseOrigin::replicates, "replicates"},
    {NoiseOrigin::smooth_shapes, "smooth_shapes"},
    {NoiseOrigin::assumed, "assumed"},
}};

/// The noise of one channel. The fit, its intervals, χ² and AICc all use it.
struct ChannelNoise {
  NoiseModel rows;  ///< σ of each fitted row
  NoiseOrigin origin = NoiseOrigin::assumed;
  double freedom = 0;  ///< degrees of freedom of an estimate

  /// Whether it is estimated or stated, so that a misfit can be compared with it.
  [[nodiscard]] bool known() const { return origin != NoiseOrigin::assumed; }
  [[nodiscard]] bool stated() const { return origin == NoiseOrigin::stated; }
};

/// The noise that the file states. Without a statement, all rows of the channel have one σ (equal variance). It comes
/// from the first available source: the deviation of replicates from their mean; the scatter about smooth shapes
/// (smooth_shapes.hpp); a hundredth of the largest value, which is an assumption. Rounding to a step q has the standard
/// error q/√12, and σ is at least that. Scatter below a millionth of the largest value is floating-point rounding, not
/// noise.
///
/// A channel without a statement always gets a σ. Throws InputError, naming `where`, for a statement without meaning;
/// warnings are as in noise_model.
ChannelNoise channel_noise(const data::Channel& channel,
                           const std::vector<std::pair<std::string, std::vector<double>>>& abscissae,
                           const std::vector<bool>& fitted, const std::string& where,
                           std::vector<std::string>& warnings);

/// One line on channels without stated noise: "stress of circ ± 0.2 kPa (smooth shapes)".
std::string noise_words(const ChannelNoise& noise, const std::string& test, const std::string& observable,
                        const std::string& unit);

}  // namespace tunica::assembly
