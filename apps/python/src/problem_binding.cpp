// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "data/nearest.hpp"
#include "execution/plan.hpp"
#include "library.hpp"
#include "module.hpp"
#include "serving/um_bridge.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

using namespace py::literals;

/// One run of an experiment as functions of its free parameters, in base units.
class RunProblem {
 public:
  RunProblem(std::shared_ptr<Loaded> loaded, const std::optional<std::string>& label)
      : loaded_(std::move(loaded)), plan_(execution::make_plan(loaded_->experiment, *loaded_->catalogue)) {
    std::vector<std::string> known;
    for (const auto& run : plan_.runs) {
      known.push_back(run.label);
      if (run_ == nullptr && (!label || run.label == *label)) run_ = &run;
    }
    if (run_ == nullptr)
      throw InputError(fmt::format("the experiment has no run '{}'. {}", label.value_or(""),
                                   data::suggestion(label.value_or(""), known)));
  }

  [[nodiscard]] const std::string& label() const { return run_->label; }
  [[nodiscard]] const assembly::Assembly& assembly() const { return *run_->assembly; }
  [[nodiscard]] const assembly::Layout& layout() const { return assembly().layout(); }
  [[nodiscard]] std::size_t dimension() const { return layout().parameters.size(); }
  [[nodiscard]] const experiment::RunEntry& entry() const { return *run_->entry; }

 private:
  std::shared_ptr<Loaded> loaded_;
  execution::Plan plan_;
  const execution::PlannedRun* run_ = nullptr;
};

py::dict evaluate_problem(const RunProblem& problem, const Array& values, bool residuals, bool jacobian) {
  const auto& layout = problem.layout();
  const auto at = vector_of(values, problem.dimension(), "parameters");
  double objective = 0;
  std::vector<double> per_test(layout.test_count), rows(residuals || jacobian ? layout.residual_count : 0),
      derivatives(jacobian ? layout.residual_count * problem.dimension() : 0);
  Status status;
  {
    const py::gil_scoped_release free;
    auto workspace = problem.assembly().evaluator().make_workspace();
    status = problem.assembly().evaluator().evaluate(at, objective, per_test, rows, derivatives, *workspace);
  }
  py::dict found;
  found["status"] = name(status.kind());
  found["reason"] = status.reason();
  found["violation"] = status.violation();
  if (status.kind() == Status::Kind::failed) return found;
  found["objective"] = objective;
  found["per_test"] = per_test;
  if (residuals) found["residuals"] = array_of(rows);
  if (jacobian) found["jacobian"] = matrix_of(derivatives, layout.residual_count, problem.dimension());
  return found;
}

py::dict predict_problem(const RunProblem& problem, const Array& values, bool jacobian) {
  const auto& layout = problem.layout();
  const auto at = vector_of(values, problem.dimension(), "parameters");
  std::vector<double> predictions(layout.prediction_count),
      derivatives(jacobian ? layout.prediction_count * problem.dimension() : 0);
  Status status;
  {
    const py::gil_scoped_release free;
    auto workspace = problem.assembly().evaluator().make_workspace();
    status = problem.assembly().evaluator().predict(at, predictions, derivatives, *workspace);
  }
  py::dict found;
  found["status"] = name(status.kind());
  found["reason"] = status.reason();
  if (!status.ok()) return found;
  found["predictions"] = array_of(predictions);
  if (jacobian) found["jacobian"] = matrix_of(derivatives, layout.prediction_count, problem.dimension());
  return found;
}

py::dict constraints_of(const RunProblem& problem, const Array& values, bool jacobian) {
  const auto at = vector_of(values, problem.dimension(), "parameters");
  const std::size_t count = problem.assembly().constraints().count();
  std::vector<double> found_values(count), derivatives(jacobian ? count * problem.dimension() : 0);
  Status status;
  {
    const py::gil_scoped_release free;
    status = problem.assembly().constraints().evaluate(at, found_values, derivatives);
  }
  py::dict found;
  found["status"] = name(status.kind());
  found["reason"] = status.reason();
  found["values"] = array_of(found_values);
  if (jacobian) found["jacobian"] = matrix_of(derivatives, count, problem.dimension());
  return found;
}

py::list parameters_of_problem(const RunProblem& problem) {
  py::list all;
  for (const auto& parameter : problem.layout().parameters)
    all.append(
        py::dict("name"_a = parameter.name, "unit"_a = parameter.unit, "min"_a = parameter.min, "max"_a = parameter.max,
                 "initial"_a = parameter.initial, "scale"_a = parameter.scale == Scale::log ? "log" : "linear",
                 "prior"_a = parameter.prior ? py::object(py::make_tuple(parameter.prior->mean, parameter.prior->sd))
                                             : py::object(py::none())));
  return all;
}

/// A number of every fitted row, and `otherwise` for the rest.
Array of_fitted_rows(const assembly::MeasuredChannel& channel, const std::vector<double>& values, double otherwise) {
  std::vector<double> all(channel.count, otherwise);
  std::size_t k = 0;
  for (std::size_t row = 0; row < channel.count; ++row)
    if (channel.fitted[row] && k < values.size()) all[row] = values[k++];
  return array_of(all);
}

/// The first row of a channel has none before it.
std::vector<double> correlations_of(const assembly::MeasuredChannel& channel) {
  std::vector<double> neighbours = channel.sigma.rows.neighbour;
  if (!neighbours.empty()) neighbours.front() = 0;
  return neighbours;
}

py::list channels_of_problem(const RunProblem& problem) {
  py::list all;
  for (const auto& channel : problem.layout().channels)
    all.append(py::dict("test"_a = channel.test, "channel"_a = channel.observable, "unit"_a = channel.unit,
                        "offset"_a = channel.offset, "measured"_a = array_of(channel.measured),
                        "abscissa"_a = array_of(channel.abscissa), "abscissa_name"_a = channel.abscissa_name,
                        "abscissa_unit"_a = channel.abscissa_unit, "fitted"_a = channel.fitted,
                        "weight"_a = channel.weight,
                        "sigma"_a = of_fitted_rows(channel, channel.sigma.rows.sd, std::nan("")),
                        "noise_origin"_a = text::code_of(assembly::noise_origin_codes, channel.sigma.origin),
                        "correlation"_a = of_fitted_rows(channel, correlations_of(channel), 0)));
  return all;
}

py::list blocks_of_problem(const RunProblem& problem) {
  py::list all;
  for (const auto& block : problem.layout().blocks)
    all.append(py::dict("offset"_a = block.offset, "size"_a = block.size, "weight"_a = block.weight,
                        "loss"_a = block.loss == ResidualBlock::Loss::quadratic ? "quadratic" : "root"));
  return all;
}

/// The status of HTTP and the document that UM-Bridge answers with.
std::pair<int, std::string> answer_of_problem(const RunProblem& problem, const std::string& path,
                                              const std::string& body) {
  const py::gil_scoped_release free;
  serving::Answer answer = serving::answer(serving::ServedRun(problem.assembly()), path, body);
  return {answer.status, std::move(answer.body)};
}

}  // namespace

void add_problem(py::module_& module) {
  module.attr("root_smoothing") = Problem::root_smoothing;
  py::class_<RunProblem>(module, "Problem")
      .def(py::init<std::shared_ptr<Loaded>, const std::optional<std::string>&>())
      .def_property_readonly("label", &RunProblem::label)
      .def_property_readonly("tests", [](const RunProblem& self) { return self.entry().tests; })
      .def_property_readonly("parameters", &parameters_of_problem)
      .def_property_readonly("channels", &channels_of_problem)
      .def_property_readonly("blocks", &blocks_of_problem)
      .def_property_readonly("exact", [](const RunProblem& self) { return self.layout().jacobian_is_exact; })
      .def("answer", &answer_of_problem)
      .def("evaluate", &evaluate_problem)
      .def("predict", &predict_problem)
      .def("constraints", &constraints_of)
      .def("from_unit",
           [](const RunProblem& self, const Array& x) {
             std::vector<double> values(self.dimension());
             self.assembly().box().from_unit(vector_of(x, self.dimension(), "x"), values);
             return array_of(values);
           })
      .def("to_unit",
           [](const RunProblem& self, const Array& values) {
             std::vector<double> x(self.dimension());
             self.assembly().box().to_unit(vector_of(values, self.dimension(), "parameters"), x);
             return array_of(x);
           })
      .def("unit_slopes", [](const RunProblem& self, const Array& values) {
        const auto at = vector_of(values, self.dimension(), "parameters");
        std::vector<double> slopes;
        for (std::size_t j = 0; j < at.size(); ++j) slopes.push_back(self.assembly().box().slope(j, at[j]));
        return array_of(slopes);
      });
}

}  // namespace tunica::python
