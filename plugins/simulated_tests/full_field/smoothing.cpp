// SPDX-License-Identifier: Apache-2.0
#include "smoothing.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/SparseCholesky>

namespace tunica::field {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr std::array<double, 5> spacings{2, 4, 8, 16, 32};  ///< wavelengths to choose from, in spacings of the points
constexpr std::size_t fold = 5;

/// Weights of ∂u/∂X and ∂u/∂Y by node: of a Gauss point, or the mean of a triangle.
using Slopes = std::array<std::map<std::size_t, double>, 2>;

void add(Slopes& slopes, const plane::Elements<6, 3>& elements, std::size_t gauss, double times) {
  for (std::size_t a = 0; a < 6; ++a) {
    slopes[0][elements.nodes[gauss / 3][a]] += times * elements.gauss[gauss].x[a];
    slopes[1][elements.nodes[gauss / 3][a]] += times * elements.gauss[gauss].y[a];
  }
}

/// Adds A |∇u₁ − ∇u₂|²/d² of two places, as rows whose squares are summed.
void add_rows(const Slopes& difference, double area, double distance, Eigen::Index& rows, Triplets& entries) {
  for (const auto& of_axis : difference) {
    for (const auto& [node, value] : of_axis) entries.emplace_back(rows, node, std::sqrt(area) / distance * value);
    ++rows;
  }
}

Vector middle(const Mesh& mesh, std::size_t triangle) {
  Vector sum{};
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t axis = 0; axis < 2; ++axis) sum[axis] += mesh.nodes[mesh.triangles[triangle][corner]][axis] / 3;
  return sum;
}

double distance(const Vector& one, const Vector& other) { return std::hypot(one[0] - other[0], one[1] - other[1]); }

Sparse square(const std::vector<Place>& places, Eigen::Index nodes) {
  Triplets entries;
  for (const Place& place : places)
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b)
        entries.emplace_back(place.nodes[a], place.nodes[b], place.weights[a] * place.weights[b]);
  Sparse matrix(nodes, nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double at(const Place& place, const Eigen::VectorXd& u) {
  double value = 0;
  for (std::size_t a = 0; a < 6; ++a) value += place.weights[a] * u[static_cast<Eigen::Index>(place.nodes[a])];
  return value;
}

}  // namespace

Smoothing::Smoothing(const Specimen& specimen) : area_(specimen.area()) {
  const auto& elements = specimen.elements();
  const Mesh& mesh = specimen.mesh();
  std::map<std::size_t, std::vector<std::size_t>> across;  // the triangles of an edge, by its middle node
  std::vector<double> areas;
  Triplets entries;
  Eigen::Index rows = 0;
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e) {
    areas.push_back(0);
    for (std::size_t q = 0; q < 3; ++q) {
      areas.back() += elements.gauss[3 * e + q].weight;
      across[mesh.triangles[e][3 + q]].push_back(e);
    }
    for (std::size_t q = 0; q < 3; ++q) {
      // Gauss points are half an edge apart.
      const std::size_t other = (q + 1) % 3;
      const double apart = 0.5 * distance(mesh.nodes[mesh.triangles[e][q]], mesh.nodes[mesh.triangles[e][other]]);
      Slopes difference;
      add(difference, elements, 3 * e + q, 1);
      add(difference, elements, 3 * e + other, -1);
      add_rows(difference, areas.back() / 3, apart, rows, entries);
    }
  }
  for (const auto& [edge, sides] : across) {
    if (sides.size() != 2) continue;
    Slopes difference;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t q = 0; q < 3; ++q) add(difference, elements, 3 * sides[side] + q, (side == 0 ? 1.0 : -1.0) / 3);
    add_rows(difference, (areas[sides[0]] + areas[sides[1]]) / 3,
             distance(middle(mesh, sides[0]), middle(mesh, sides[1])), rows, entries);
  }
  Sparse B(rows, static_cast<Eigen::Index>(mesh.nodes.size()));
  B.setFromTriplets(entries.begin(), entries.end());
  bending_ = B.transpose() * B;
}

Eigen::MatrixXd Smoothing::at_nodes(const std::vector<Place>& places, const Eigen::MatrixXd& values,
                                    double wavelength) const {
  const Eigen::Index nodes = bending_.rows();
  const double density = static_cast<double>(places.size()) / area_;
  const Sparse A = square(places, nodes) + density * std::pow(wavelength / (2 * std::numbers::pi), 4) * bending_;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(nodes, values.cols());
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t a = 0; a < 6; ++a)
      right.row(static_cast<Eigen::Index>(places[k].nodes[a])) +=
          places[k].weights[a] * values.row(static_cast<Eigen::Index>(k));
  return Eigen::SimplicialLDLT<Sparse>(A).solve(right);
}

double Smoothing::wavelength(const std::vector<Place>& places, const Eigen::VectorXd& values) const {
  std::vector<Place> kept;
  std::vector<double> their;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (k % fold != fold / 2) {
      kept.push_back(places[k]);
      their.push_back(values[static_cast<Eigen::Index>(k)]);
    }
  const Eigen::VectorXd known = Eigen::Map<Eigen::VectorXd>(their.data(), static_cast<Eigen::Index>(their.size()));
  const double spacing = std::sqrt(area_ / static_cast<double>(places.size()));
  double best = 0, least = 1e300;
  for (const double length : spacings) {
    const Eigen::VectorXd u = at_nodes(kept, known, length * spacing);
    double miss = 0;
    for (std::size_t k = fold / 2; k < places.size(); k += fold)
      miss += std::pow(at(places[k], u) - values[static_cast<Eigen::Index>(k)], 2);
    if (miss < least) {
      least = miss;
      best = length * spacing;
    }
  }
  return best;
}

}  // namespace tunica::field
