// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tunica/model.hpp"
#include "tunica/options.hpp"

namespace tunica {

/// A quantity of a test that a data column can be mapped to.
struct Observable {
  /// The use of a column.
  enum class Role {
    abscissa,  ///< prescribed in the experiment and given to the test
    channel,   ///< measured, and compared with the prediction
    time       ///< the clock, in s; models with history need it
  };
  /// The checks and conversions of the host beyond the unit.
  enum class Kind {
    plain,    ///< nothing
    stretch,  ///< the host warns of a strain or a percentage in place of a stretch
    stress    ///< the data state a stress measure: Cauchy, first or second Piola–Kirchhoff
  };
  /// Name in "columns" of the experiment file, for example "stretch".
  std::string name;
  /// Base unit in UDUNITS spelling.
  std::string unit;
  /// What the column is used for.
  Role role = Role::channel;
  /// Whether a file that maps no column to it is refused.
  bool required = false;
  /// One sentence.
  std::string doc;
  /// What the host checks and converts.
  Kind kind = Kind::plain;
  /// For a channel: its abscissa in plots and messages, for example the axial stretch for an axial stress. Empty: the
  /// host takes the abscissa that varies over the rows. It also does so if the data do not map this abscissa, or hold
  /// it while another one varies.
  std::string over = {};
};

/// The rows of one experiment in loading order, in base units. Spans are valid during the call that receives them.
struct TestRows {
  /// The values of one mapped observable.
  struct Column {
    std::string observable;          ///< Observable::name
    std::span<const double> values;  ///< one a row
    /// Whether this is a stretch 1 + d/L, with a measured change of length d and a gauge length L, or 1 + strain. A
    /// wrong gauge length then scales the stretch minus 1. It scales any other stretch as a whole.
    bool from_elongation = false;
  };
  /// n, the number of rows.
  std::size_t count = 0;
  /// The mapped observables of role abscissa.
  std::vector<Column> abscissae;
  /// Names of the fitted observables. Predictions come in this order.
  std::vector<std::string> channels;
  /// n entries: time of each row, s. Empty = equilibrium.
  std::span<const double> time;
};

/// The card that a test requests from TestSetup::card.
struct CardRequest {
  std::string program;   ///< a target of `tunica export`, for example "calculix"
  std::string units;     ///< its system of units, for example "mm-N-MPa"
  std::string material;  ///< the name of the material in the card
};

/// The arguments of TestFactory::create. The test copies what it keeps.
struct TestSetup {
  /// The options of the test, as TestFactory::options declares them; checked.
  Options options;
  /// The rows of the data file, or the rows to simulate.
  TestRows rows;
  /// Measure of the data's stress: "cauchy", "first_piola_kirchhoff" or "second_piola_kirchhoff".
  std::string stress_measure;
  /// Thickness of each layer from inside, in mm, positive. Empty = one model; others only if TestFactory::layered.
  std::vector<double> layers = {};
  /// The folder of the experiment file, absolute. Relative file names in options refer to it.
  std::string folder = {};
  /// Factor from one unit to another, in UDUNITS spelling: unit_factor("kPa", "MPa") = 0.001. It throws InputError if a
  /// unit is unknown or the dimensions differ. Empty if the host has no units.
  std::function<double(std::string_view from, std::string_view to)> unit_factor = {};
  /// The material card of a model for a finite-element program: card(model, values, {"calculix", "mm-N-MPa",
  /// "TISSUE"}). It throws InputError if the program cannot express the model. Empty if the host writes no cards.
  std::function<std::string(const Model& model, std::span<const double> parameters, const CardRequest& request)> card =
      {};
  /// The measured values of every channel of `rows`, n entries each; NaN = not measured. A test needs them if it
  /// prescribes some of the values that it is compared with, for example the displacements of an edge. Empty if nothing
  /// was measured.
  std::vector<std::span<const double>> measured = {};
  /// Whether the user interrupted the work. A test that waits for something outside the process calls it ten times a
  /// second. After an interruption it gives up and returns `failed`, which the host does not record. Empty if the host
  /// cannot be interrupted.
  std::function<bool()> interrupted = {};
};

/// How the host differences a test that never provides derivatives, whatever the model.
///
///     forward:  ∂f/∂p_j ≈ (f(p + h_j e_j) − f(p)) / h_j           one prediction a parameter
///     central:  ∂f/∂p_j ≈ (f(p + h_j e_j) − f(p − h_j e_j)) / 2h_j  two
///
/// with h_j = step · |p_j|, but on a linear scale at least step times a hundredth of the range. The predictions run in
/// parallel. Between differences a search may use Broyden's update of the Jacobian J of its last point, which costs no
/// prediction (Broyden, Math. Comp. 19:577, 1965; here with scaled parameters):
///
///     J⁺ = J + (Δf − J Δp) (W Δp)ᵀ / (Δpᵀ W Δp),  W = diag(1/scale_j²)
struct Differencing {
  double step = 1e-4;    ///< relative; the error of the simulation's numbers, divided by it, enters the derivative
  bool central = false;  ///< whether two predictions are made a parameter
  bool updates = false;  ///< whether Broyden's update replaces differences while it predicts well
};

/// The properties of a test. They never change during the test's life.
struct TestDescription {
  /// The volume of the specimen, as the test simulates it.
  enum class Volume {
    kept,   ///< J = 1, whatever the model: compressible models are refused
    free,   ///< J changes, as the load prescribes: incompressible models are refused
    either  ///< J = 1 where Model::keeps_volume() says so; elsewhere the test solves for its free faces
  };
  /// The test's own parameters, among them the imperfections that it can simulate.
  std::vector<Parameter> parameters;
  /// The null of each parameter: the value at which an imperfection vanishes. NaN marks an ordinary parameter, which
  /// is fitted unless the file fixes it; the others rest at their null unless a mechanism frees them.
  std::vector<double> nulls;
  /// Names of the diagnostics: quantities that the test reports but that are not fitted, for example
  /// "transverse_stretch".
  std::vector<std::string> diagnostics;
  /// Base unit of each diagnostic.
  std::vector<std::string> diagnostic_units;
  /// The material axis that a strip with free lateral faces is pulled along to its abscissa "stretch": 0 =
  /// circumferential, 1 = axial. The host then checks transverse stability. None for other tests.
  std::optional<std::size_t> free_strip_axis = {};
  /// Whether the Jacobian is exact along the whole path even for a model with memory, if the model's axis_history_size
  /// is not 0. Otherwise the host differences predictions.
  bool path_derivatives = false;
  /// The test's parameters that must rest at their null for such an exact Jacobian. If one is free or has another
  /// value, the host differences.
  std::vector<std::string> path_exceptions = {};
  /// Whether a prediction takes long, as with finite elements. The host then runs cheaper tests first, and skips this
  /// one if they fail. At a point that violates a constraint, it runs only for optimizers that need it, see
  /// Optimizer::Needs::infeasible.
  bool costly = false;
  /// Set by a test that never has derivatives. The host differences it as declared here.
  std::optional<Differencing> differencing = {};
  /// The names of the model's parameters on which a prediction depends. The host refuses a run that frees others in
  /// this test, and refuses names that the model lacks. None = all.
  std::optional<std::vector<std::string>> reads = {};
  /// The materials that the test can carry. The host refuses others.
  Volume volume = Volume::kept;
};

/// The input of one prediction. The test keeps nothing of it.
struct TestInput {
  /// The model of the first layer, or the only one.
  const Model& model;
  /// Parameters of all layers, one layer after the other.
  std::span<const double> model_parameters;
  /// The test's parameters, in the order of TestDescription.
  std::span<const double> test_parameters;
  /// Abscissae in place of the rows' own, one span for each mapped abscissa: a mechanism corrects readings this way.
  /// Empty = the rows' own.
  std::span<const std::span<const double>> abscissae = {};
  /// The model of each layer of TestSetup::layers; several layers may share a model. Empty = `model` alone. Every
  /// layer has its own copy of the parameters and its own rows of the Jacobian; the host adds shared ones up.
  std::span<const Model* const> layers = {};
};

/// The output of one prediction, in the caller's memory. An empty span means "not wanted".
///
/// With c channels and n rows, channel k of row i is at [k·n + i].
struct TestOutput {
  /// c·n entries: predictions, in base units and in the stress measure of the data.
  std::span<double> values;
  /// (n_model + n_test)·c·n entries: ∂values/∂p_j at [j·c·n + k·n + i], parameters of the model before the test's.
  std::span<double> jacobian;
  /// n_abscissae·c·n entries: derivatives by the abscissa of the same row, abscissa a at [a·c·n + k·n + i].
  std::span<double> abscissa_derivative;
  /// n_diagnostics·n entries: diagnostic d of row i at [d·n + i].
  std::span<double> diagnostics;
};

/// The distance between a test and an independent solution of a problem that both can solve, with one material.
struct Agreement {
  /// The compared problem and quantity: "the semi-analytic long tube, ends sliding: outer diameter stretch".
  std::string with;
  /// The largest difference, in `unit`.
  double difference = 0;
  /// Unit of both numbers, as printed.
  std::string unit;
  /// The largest difference that discretisation explains. A larger one is a fault.
  double expected = 0;
  /// c·n entries, as TestOutput::values: the change of the predictions under a finer discretisation of the same
  /// problem. The host computes the bias of fitted parameters from it, and sums the biases of several comparisons.
  /// Empty for another kind of comparison.
  std::vector<double> shift = {};
};

/// Fields over a simulated body at one row, on a mesh of quadrilaterals.
struct Snapshot {
  /// One scalar, vector or tensor over the body.
  struct Field {
    std::string name;            ///< for example "cauchy_stress"
    std::string unit;            ///< base unit
    std::size_t components = 1;  ///< 1, 3 or 6, in the order of VTK
    bool of_cells = false;       ///< whether values belong to cells instead of points
    std::vector<double> values;  ///< all components of the first point, then of the second, …
  };
  /// One column of the table along a line.
  struct Column {
    std::string name;            ///< heading
    std::string unit;            ///< base unit
    std::vector<double> values;  ///< one a point of the line
  };
  std::size_t row = 0;             ///< the row of the test, from 0
  std::vector<double> points;      ///< x, y, z of each point in the loaded state, mm
  std::vector<std::size_t> cells;  ///< four point indices a cell, in turn around it
  std::vector<Field> fields;       ///< any number of fields
  std::vector<Column> section;     ///< a table along a line, for example through a wall; may be empty
};

/// A count that a test keeps of its own work, for results: {"solver_runs", 34}.
struct Effort {
  std::string name;         ///< lower case, with underscores
  std::uint64_t count = 0;  ///< since the test was made
};

/// Simulates one experiment with a model, at the rows that it was made with.
///
/// Required: describe(), rows() and predict(). Rows come in loading order; a model with history sees them in that
/// order, with time if the data have it, else at equilibrium. If every row's deformation follows from its abscissa
/// alone, tunica/tests/point_test.hpp needs only two formulas. A test around another one begins with
/// tunica/tests/decorated_test.hpp.
///
/// Derivatives: the Jacobian is exact if the model has parameter derivatives. If it has none, the test returns `failed`
/// when a Jacobian is wanted, and the host differences whole predictions. For a model with memory,
/// TestDescription::path_derivatives says whether the Jacobian is exact.
/// Threads: every method is const and is called concurrently.
/// Failure: a status whose reason names row and abscissa; never a NaN under `ok`, never an exception.
/// Ownership: the test owns its copy of the rows and the result of describe().
class Test {
 public:
  virtual ~Test() = default;
  /// The properties of the test. Called at any time, so it returns a member.
  [[nodiscard]] virtual const TestDescription& describe() const = 0;
  /// The rows that it was made with. Their spans point into the test.
  [[nodiscard]] virtual const TestRows& rows() const = 0;
  /// Simulates every row. Writes the outputs that are not empty, and nothing else.
  virtual Status predict(const TestInput& input, const TestOutput& output) const = 0;
  /// Optional, for `tunica check`: compares the simulation with other solutions, and appends to `found`.
  virtual Status agreement([[maybe_unused]] const TestInput& input,
                           [[maybe_unused]] std::vector<Agreement>& found) const {
    return {};
  }
  /// Optional, for `tunica simulate --fields`: appends one snapshot for each of the given rows.
  virtual Status snapshots([[maybe_unused]] const TestInput& input, [[maybe_unused]] std::span<const std::size_t> rows,
                           [[maybe_unused]] std::vector<Snapshot>& found) const {
    return Status::failed("this test has no fields to show");
  }
  /// Optional, for results: counts of its work so far, always in the same order.
  [[nodiscard]] virtual std::vector<Effort> efforts() const { return {}; }
};

}  // namespace tunica
