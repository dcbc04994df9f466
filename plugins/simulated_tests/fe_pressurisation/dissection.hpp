// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesh.hpp"
#include "panels.hpp"
#include "stencil.hpp"

namespace tunica::fe {

/// The cost of a factor: multiply–adds, and doubles of storage and workspace.
struct FactorCost {
  double operations = 0, kept = 0, working = 0;
  [[nodiscard]] double bytes() const { return 8 * (kept + working); }
};

/// L D Lᵀ of the matrix of a mesh, ordered by nested dissection and factorised front by front.
///
/// A line of nodes cuts the wall in two, each part is cut again, and so on down to small blocks. The nodes of a cut
/// come after those on both sides of it, which do not see each other. A front is the dense matrix of the nodes that are
/// eliminated together and of those on the cuts around them. What the elimination leaves to the latter is added to the
/// front that comes next up. For N nodes of a square that takes N^1.5 operations and N log N entries, where the band
/// takes N² and N^1.5.
/// Sources: A. George, SIAM J. Numer. Anal. 10 (1973) 345–363; I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983)
/// 302–325.
class Dissection {
 public:
  static FactorCost cost(const Mesh& mesh);

  /// The order of a mesh and the places of the entries of its matrix. False where it became late.
  bool prepare(const Mesh& mesh, const Stencil& matrix, const std::function<bool()>& late = {});
  /// Rows and columns `fixed` become those of the unit matrix, times `diagonal`; then as Banded::factorise().
  std::optional<std::size_t> factorise(const Stencil& matrix, std::span<const std::size_t> fixed, double diagonal,
                                       const std::function<bool()>& late);
  /// x = (L D Lᵀ)⁻¹ x.
  void solve(std::span<const std::span<double>> x) const;

  /// Doubles, as cost() says.
  [[nodiscard]] std::size_t kept() const { return a_.size(); }
  [[nodiscard]] std::size_t working() const { return stack_.size(); }

 private:
  /// Rows of consecutive numbers, here and in the next front up.
  struct Run {
    std::uint32_t from, to, length;
  };
  /// Its rows are first those eliminated, filled up to whole panels, then those around them, filled up, too.
  struct Front {
    std::size_t eliminated = 0, around = 0;  ///< positions
    std::size_t own = 0, height = 0;         ///< rows, filled up: those eliminated, all
    std::size_t place = 0, first_panel = 0, positions = 0, first_entry = 0, last_entry = 0;  ///< in the arrays below
    std::size_t made = 0, waits = 0;  ///< what it leaves, in stack_
    std::vector<std::size_t> children;
    std::vector<Run> runs;  ///< of what it leaves
    [[nodiscard]] std::size_t left() const { return height - own; }
  };
  /// An entry of the matrix and its place in a front.
  struct Entry {
    std::uint32_t from, to;
  };
  /// Elements between lines, which are cuts or edges of the wall.
  struct Part {
    std::size_t left, right, low, high;
    bool cut_left = false, cut_right = false, cut_low = false, cut_high = false;
  };
  struct Nodes {
    std::vector<std::size_t> own, around;
  };
  /// Asks whether it is late, whenever enough operations have been announced.
  struct Questions {
    const std::function<bool()>& late;
    double since = 0;

    bool late_after(double operations) {
      since += operations;
      if (!late || since < between_questions) return false;
      since = 0;
      return late();
    }
  };

  static bool small(const Mesh& mesh, const Part& part);
  static std::array<Part, 2> halves(const Part& part);
  static Nodes nodes_of(const Mesh& mesh, const Part& part);
  static FactorCost cost(const Mesh& mesh, const Part& part, double& left);
  std::size_t dissect(const Mesh& mesh, const Part& part, std::vector<Nodes>& nodes);
  bool locate(const Mesh& mesh, const Stencil& matrix, const std::function<bool()>& late);
  void load(const Front& front, const Stencil& matrix, double diagonal);
  static void extend(const Front& from, const Front& to, const double* left, double* a, double* to_left);
  // Both have to be inlined into the kernel of a level, else they have the instructions of none.
  template <class Vector, std::size_t Vectors, std::size_t Columns>
  [[gnu::always_inline]] inline std::optional<std::size_t> eliminate(const Front& front, double* left,
                                                                     Questions& questions);
  template <class Vector>
  [[gnu::always_inline]] inline void substitute(std::span<const std::span<double>> x, double* rows) const;

  std::size_t size_ = 0, tallest_ = 0;
  std::vector<Front> fronts_;             ///< in the order of elimination
  std::vector<std::uint32_t> positions_;  ///< of each front: those eliminated, those around
  std::vector<Entry> entries_;
  std::vector<char> fixed_;
  std::vector<double, Aligned<double>> a_;      ///< of each front the columns eliminated
  std::vector<double, Aligned<double>> stack_;  ///< what fronts leave
  std::vector<double, Aligned<double>> scaled_, inverse_, inverse_pivot_;
};

}  // namespace tunica::fe
