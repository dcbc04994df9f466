// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// How the rows of a test become the curves that a person would draw.
namespace tunica::data {

/// One prescribed quantity of the rows of a test.
struct Prescribed {
  std::string name, unit;
  std::vector<double> values;  ///< one a row
};

/// The abscissa of a channel in plots.
struct Abscissa {
  std::size_t column = 0;           ///< in the prescribed quantities
  std::vector<std::string> curves;  ///< one a row, "stretch_axial = 1.3"; empty where all rows are one curve
};

/// Chooses for one channel. `own` names the abscissa that its plugin declares for it; "" = none.
///
/// Rows that hold one quantity over a stretch of rows while another one varies are a family of curves. They are drawn
/// over what varies, whatever `own` says. Otherwise a channel is drawn over its own abscissa where that is swept, else
/// over the quantity that wanders least on its way through its range. A pressure that was to be held still shows its
/// noise. `prescribed` holds at least one quantity, all of the same length.
Abscissa abscissa_of(std::span<const Prescribed> prescribed, const std::string& own);

/// Whether each prescribed quantity rests over more than half of the rows: what happens there is drawn over time, if
/// there is one. A quantity rests over a run of rows that stays within 2 % of its range, three times as long as that of
/// an even ramp, and four rows at least.
bool is_over_time(std::span<const Prescribed> prescribed, std::span<const double> time);

/// Rows to be drawn as one line.
struct Line {
  std::string curve;              ///< the name of its family member, "" = none
  std::vector<std::size_t> rows;  ///< positions, in the order in which to join them
  bool path = true;               ///< false: the order of the rows says nothing; they go from low to high abscissa
};

/// Parts rows at a change of curve and where the abscissa jumps, but not onwards. Rows that go to and fro in long
/// passes are joined in their order, as loops; the order of other rows means nothing and they are sorted. `curves` has
/// one name a row or none at all. Rows without a finite abscissa belong to no line.
std::vector<Line> lines_of(std::span<const double> abscissa, std::span<const std::string> curves);

}  // namespace tunica::data
