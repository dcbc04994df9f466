// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "assembly/noise.hpp"
#include "text/codes.hpp"

namespace tunica::assembly {

/// What the σ of a channel rests on.
enum class NoiseOrigin { stated, replicates, smooth_shapes, assumed };

inline constexpr text::Codes<NoiseOrigin, 4> noise_origin_codes{{
    {NoiseOrigin::stated, "stated"},
    {NoiseOrigin::replicates, "replicates"},
    {NoiseOrigin::smooth_shapes, "smooth_shapes"},
    {NoiseOrigin::assumed, "assumed"},
}};

/// The noise of one channel: what the fit, its intervals, χ² and AICc read.
struct ChannelNoise {
  NoiseModel rows;  ///< σ of each fitted row
  NoiseOrigin origin = NoiseOrigin::assumed;
  double freedom = 0;  ///< degrees of freedom of an estimate

  /// An estimate or a statement, with which misfit can be compared.
  [[nodiscard]] bool known() const { return origin != NoiseOrigin::assumed; }
  [[nodiscard]] bool stated() const { return origin == NoiseOrigin::stated; }
};

/// As the file states it; else one σ for all rows of the channel (equal variance), from the first of these that there
/// is: the deviation of replicates from their mean; the scatter about smooth shapes (smooth_shapes.hpp); a hundredth
/// of the largest value, which is an assumption. Rounding to a step q errs by q/√12, and σ is at least that. A scatter
/// below a millionth of the largest value is rounding of a computer, and no noise.
///
/// Always gives an answer for a channel that states none. Throws InputError for a statement that means nothing, naming
/// `where`; warnings as in noise_model.
ChannelNoise channel_noise(const data::Channel& channel,
                           const std::vector<std::pair<std::string, std::vector<double>>>& abscissae,
                           const std::vector<bool>& fitted, const std::string& where,
                           std::vector<std::string>& warnings);

/// One line on channels whose noise nobody stated: "stress of circ ± 0.2 kPa (smooth shapes)".
std::string noise_words(const ChannelNoise& noise, const std::string& test, const std::string& observable,
                        const std::string& unit);

}  // namespace tunica::assembly
