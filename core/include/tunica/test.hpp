// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/model.hpp"
#include "tunica/options.hpp"

namespace tunica {

/// A quantity of a test that a data column can be mapped to.
struct Observable {
  /// What the column is for.
  enum class Role { abscissa, channel, time };  ///< prescribed; measured and predicted; clock
  /// What the host may check and convert.
  enum class Kind { plain, stretch, stress };  ///< stretch: percent-for-fraction check; stress: has a measure
  std::string name;                            ///< "stretch", "stress", "transverse_stretch"
  std::string unit;                            ///< base unit
  Role role = Role::channel;                   ///< abscissae are given to the test, channels are compared with it
  bool required = false;                       ///< a file that maps no column to it is refused
  std::string doc;                             ///< one sentence
  Kind kind = Kind::plain;                     ///< plain: nothing beyond its unit
};

/// The rows of one test in loading order, in base units; spans live as long as the call that receives them.
struct TestRows {
  /// The values of one mapped observable.
  struct Column {
    std::string observable;          ///< Observable::name
    std::span<const double> values;  ///< one per row
  };
  std::size_t count = 0;              ///< rows
  std::vector<Column> abscissae;      ///< mapped observables of role abscissa
  std::vector<std::string> channels;  ///< fitted observables, in the order of the predictions
  std::span<const double> time;       ///< s; empty = equilibrium
};

/// What a test is made from. The test copies what it keeps.
struct TestSetup {
  Options options;             ///< as TestFactory::options declares them, checked
  TestRows rows;               ///< of the data file, or of the ones to simulate
  std::string stress_measure;  ///< "cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"
  /// Thickness in mm of each layer from inside, positive, where the type takes layers (TestFactory::layered) and the
  /// file gives them; empty = one model.
  std::vector<double> layers = {};
};

/// What a test says of itself; it never changes during the test's life.
struct TestDescription {
  std::vector<Parameter> parameters;     ///< the test's own, and its native imperfections
  std::vector<double> nulls;             ///< null of each parameter; NaN = an ordinary parameter, fitted unless fixed
  std::vector<std::string> diagnostics;  ///< names of the diagnostics rows, for example "transverse_stretch"
  std::vector<std::string> diagnostic_units;  ///< base unit of each
  /// A strip with free lateral faces, pulled along this material axis (0 = circumferential, 1 = axial) to the values of
  /// its abscissa "stretch": there the host can ask for transverse stability.
  std::optional<std::size_t> free_strip_axis = {};
  /// Not worth simulating where cheaper tests fail or a constraint is broken (finite elements): the host does it last,
  /// and at a point that breaks a constraint only for an optimiser that needs it there, see Optimizer::Needs.
  bool costly = false;
};

/// What one prediction is made of; nothing of it is kept.
struct TestInput {
  const Model& model;                        ///< of the first layer, where there are several
  std::span<const double> model_parameters;  ///< of all layers, one after the other
  std::span<const double> test_parameters;   ///< in the order of TestDescription
  /// Abscissae instead of the bound ones (a mechanism corrects them): one span per mapped abscissa, or empty.
  std::span<const std::span<const double>> abscissae = {};
  /// The model of each layer of TestSetup::layers, one model perhaps in several of them; empty = `model` alone. A layer
  /// that shares its model has its own copy of the parameters, and own rows of the Jacobian: the host adds them up.
  std::span<const Model* const> layers = {};
};

/// Predictions into memory of the caller; with c channels and n rows, channel k of row i at [k·n + i].
/// An empty span means "not wanted".
struct TestOutput {
  std::span<double> values;    ///< c·n, in base units and in the data's stress measure
  std::span<double> jacobian;  ///< (n_model + n_test)·c·n; ∂values/∂p_j at [j·c·n + …], model first
  std::span<double> abscissa_derivative;  ///< n_abscissae·c·n; ∂values/∂(abscissa a of the same row)
  std::span<double> diagnostics;          ///< n_diagnostics·n
};

/// How far a test is from an independent solution of a problem that both can solve, at the same material.
struct Agreement {
  std::string with;       ///< "the semi-analytic long tube, ends sliding: outer diameter stretch"
  double difference = 0;  ///< the largest, in `unit`
  std::string unit;       ///< as printed
  double expected = 0;    ///< what discretisation explains; beyond it something is wrong
};

/// Fields over a simulated body at one row, on a mesh of quadrilaterals.
struct Snapshot {
  /// One scalar, vector or tensor over the body.
  struct Field {
    std::string name,            ///< "cauchy_stress"
        unit;                    ///< base unit
    std::size_t components = 1;  ///< 1, 3 or 6, as VTK has them
    bool of_cells = false;       ///< one value a cell instead of one a point
    std::vector<double> values;  ///< components of the first point, of the second, …
  };
  std::size_t row = 0;             ///< of the test
  std::vector<double> points;      ///< x, y, z of each, in the loaded state, mm
  std::vector<std::size_t> cells;  ///< four points each, in turn around it
  std::vector<Field> fields;       ///< any number
  /// One column of the table.
  struct Column {
    std::string name,            ///< heading
        unit;                    ///< base unit
    std::vector<double> values;  ///< one a point of the line
  };
  std::vector<Column> section;  ///< a table along a line worth looking at, as through a wall; may be empty
};

/// Simulates one experiment with a model, at the rows it was made with.
///
/// Required: describe, predict. Rows are in loading order; a model with history sees them so, with time where the
/// data have it, else at equilibrium. The Jacobian is exact where the model has parameter derivatives; else the
/// test returns `failed` when it is asked for one and the host differences whole predictions.
/// Threads: const, safe to call concurrently. Failure: a status with a reason that names row and abscissa, never a
/// NaN under `ok`, never an exception. Ownership: the test owns its copy of the rows.
class Test {
 public:
  virtual ~Test() = default;
  [[nodiscard]] virtual const TestDescription& describe() const = 0;  ///< cheap; asked at any time
  [[nodiscard]] virtual const TestRows& rows() const = 0;  ///< the rows it was made with; spans into the test
  /// Simulates every row; writes what `output` has room for.
  virtual Status predict(const TestInput& input, const TestOutput& output) const = 0;
  /// Checks of the simulation by other means, for `tunica check`; appends to `found`. Optional.
  virtual Status agreement(const TestInput& input, std::vector<Agreement>& found) const {
    static_cast<void>(input), static_cast<void>(found);
    return {};
  }
  /// Fields at the given rows, one snapshot each; for `tunica simulate --fields`. Optional.
  virtual Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                           std::vector<Snapshot>& found) const {
    static_cast<void>(input), static_cast<void>(rows), static_cast<void>(found);
    return Status::failed("this test has no fields to show");
  }
};

}  // namespace tunica
