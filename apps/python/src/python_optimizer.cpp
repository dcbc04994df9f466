// SPDX-License-Identifier: Apache-2.0
#include "python_optimizer.hpp"

#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tunica::python {

namespace py = pybind11;

namespace {

py::tuple told(const Status& status, double objective) {
  return py::make_tuple(name(status.kind()), status.reason(), objective);
}

}  // namespace

Problem& SearchOfOptimizer::get() const {
  if (problem_ == nullptr)
    throw InputError("the problem of a search is gone when the search has ended; take what you need of it before");
  return *problem_;
}

py::tuple SearchOfOptimizer::evaluate(const Array& x) const {
  Problem& problem = get();
  const auto at = vector_of(x, problem.dimension(), "x");
  double objective = std::numeric_limits<double>::infinity();
  Status status;
  {
    const py::gil_scoped_release free;
    status = problem.evaluate(at, objective);
  }
  return told(status, objective);
}

py::list SearchOfOptimizer::evaluate_batch(const Array& xs) const {
  Problem& problem = get();
  const std::size_t n = problem.dimension(), count = n > 0 ? static_cast<std::size_t>(xs.size()) / n : 0;
  if (count * n != static_cast<std::size_t>(xs.size()))
    throw InputError(fmt::format("xs: found {} numbers, expected rows of {}", xs.size(), n));
  std::vector<double> objectives(count, std::numeric_limits<double>::infinity());
  std::vector<Status> statuses(count);
  {
    const py::gil_scoped_release free;
    problem.evaluate_batch(span_of(xs), objectives, statuses);
  }
  py::list all;
  for (std::size_t k = 0; k < count; ++k) all.append(told(statuses[k], objectives[k]));
  return all;
}

py::tuple SearchOfOptimizer::linearise(const Array& x) const {
  Problem& problem = get();
  const auto at = vector_of(x, problem.dimension(), "x");
  const std::size_t n = problem.dimension(), m = problem.residual_count();
  double objective = std::numeric_limits<double>::infinity();
  std::vector<double> residuals(m), jacobian(m * n);
  Status status;
  {
    const py::gil_scoped_release free;
    status = problem.linearise(at, objective, residuals, jacobian);
  }
  return py::make_tuple(name(status.kind()), status.reason(), objective, array_of(residuals),
                        matrix_of(jacobian, m, n));
}

py::tuple SearchOfOptimizer::constraints(const Array& x) const {
  Problem& problem = get();
  const auto at = vector_of(x, problem.dimension(), "x");
  const std::size_t n = problem.dimension(), m = problem.constraint_count();
  std::vector<double> values(m), jacobian(m * n);
  Status status;
  {
    const py::gil_scoped_release free;
    status = problem.constraints(at, values, jacobian);
  }
  return py::make_tuple(name(status.kind()), status.reason(), array_of(values), matrix_of(jacobian, m, n));
}

std::size_t SearchOfOptimizer::for_each_start(std::size_t count, const py::object& body) const {
  Problem& problem = get();
  std::exception_ptr raised;
  std::size_t begun = 0;
  {
    const py::gil_scoped_release free;
    begun = problem.for_each_start(count, [&](std::size_t k, Problem& child) {
      const py::gil_scoped_acquire lock;
      const auto search = std::make_shared<SearchOfOptimizer>(child);
      try {
        body(k, search);
      } catch (...) {
        if (!raised) raised = std::current_exception();
      }
      search->expire();
    });
  }
  if (raised) std::rethrow_exception(raised);
  return begun;
}

Optimizer::Outcome PythonOptimizer::minimise(Problem& problem) {
  const py::gil_scoped_acquire lock;
  const auto search = std::make_shared<SearchOfOptimizer>(problem);
  try {
    const auto [converged, reason] = object_.get().attr("minimise")(search).cast<std::pair<bool, std::string>>();
    search->expire();
    return {converged, reason};
  } catch (py::error_already_set& raised) {
    search->expire();
    throw std::runtime_error(reason_of(owner_, raised));
  } catch (const py::cast_error& problem_of_answer) {
    search->expire();
    throw std::runtime_error(owner_ + ": " + problem_of_answer.what());
  }
}

}  // namespace tunica::python
