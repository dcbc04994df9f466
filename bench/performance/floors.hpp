// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Hand-fused kernels that do what a row of the benchmark needs and nothing else: no framework, no check, no failure.
/// They are measured in the process and the minute of the row they bound, so that the speed of the machine cancels.
///
/// floors.cpp is compiled once a set of instructions. This header and that file include no library code: an inline
/// function compiled for AVX2 must never replace the same one of the program.
namespace tunica::bench::floors {

inline constexpr std::size_t most_shapes = 3;

/// The energies of two mirrored fibre families in the principal axes t, z, r:
///   W = μ/2 (I1 − 3) + k1/k2 [exp(k2 E²) − 1],   E = Σ_a e_a c_a − 1 > 0.
/// The e_a depend on `shapes` parameters: κ, θ of gho; A, B, θ of holzapfel_2015.
struct Energy {
  double mu, k1, k2;
  double e[3];                      ///< of t, z, r
  std::size_t shapes;               ///< parameters beside mu, k1, k2
  double by_shape[most_shapes][3];  ///< ∂e_a by them
};

/// One strip pulled along t (`axial` false) or z. Arrays of n; lanes across points. The lateral equilibrium is solved
/// by 2 to 4 Newton steps from the solution before; the stress takes the last one to first order.
struct Strip {
  std::size_t n;
  int steps;
  bool axial;
  const double* pulled;    ///< squared stretch along the strip
  const double* measured;  ///< Cauchy stress, kPa
  double* lateral;         ///< squared stretch across; read as the start, written
  double* residual;        ///< nullptr: not wanted
  double* jacobian;        ///< parameter j of point i at [j·n + i], order mu, k1, k2, shapes; nullptr: not wanted
};

/// Material points: squared stretches at [a·n + i]; outputs in the layout of AxisResponse; nullptr: not wanted.
struct Points {
  std::size_t n;
  const double* c;
  double *energy, *gradient, *hessian, *gradient_dp;
};

/// A sheet with both stretches prescribed: Cauchy stresses of t and z against the measured ones at [a·n + i].
struct Sheet {
  std::size_t n;
  const double *c, *measured;
  double *residual, *jacobian;
};

/// A long tube without residual stress under `n` pressures: 2 to 4 Newton steps for y = ln ri, from the solution
/// before.
struct Tube {
  std::size_t n, sections;  ///< Gauss points through the wall
  int steps;
  const double *node, *weight;        ///< on [0, 1]
  double inner, outer, cz;            ///< mm; squared axial stretch
  const double *pressure, *measured;  ///< kPa; outer diameter stretch
  double* y;                          ///< read as the start, written
  double *residual, *jacobian;
};

/// Four-node elements of a tube with constant pressures, `radial` by `axial` of them, over half the length. Node (i, k)
/// is k (radial + 1) + i and has r, z at [2 · node]. The wall's potential is ∫ [W(C) − q (J − 1)] R dR dZ.
struct Elements {
  std::size_t radial, axial;
  double inner, outer;  ///< mm
  const double* layer;  ///< Z of the axial + 1 planes of nodes
  const double *x, *q;  ///< positions; pressures, element e of row k at [k · radial + e]
  double gamma;         ///< weight of G Gᵀ/M in the matrix
  double* force;        ///< first derivatives by x
  double* matrix;       ///< lower half by columns of width + 1, width = 2 (radial + 2) + 1; nullptr: not wanted
};

/// The kernels for one set of instructions.
struct Kernels {
  const char* level;
  double (*strip)(const Energy&, const Strip&);  ///< sum of squared residuals
  void (*points)(const Energy&, const Points&);
  double (*sheet)(const Energy&, const Sheet&);
  double (*tube)(const Energy&, const Tube&);
  void (*elements)(const Energy&, const Elements&);
  void (*multiply_add)(double* to, const double* from, std::size_t repeats);  ///< 512 multiply–adds a repeat, in cache
};

const Kernels& baseline();
const Kernels& avx2();
const Kernels& avx512();

}  // namespace tunica::bench::floors
