// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "tunica/options.hpp"
#include "tunica/status.hpp"

namespace tunica::python {

/// A Python object that C++ keeps: copied and dropped by any thread, without the interpreter's lock. It is looked at
/// with the lock only. Objects that outlive the interpreter are left to the end of the process.
class Kept {
 public:
  explicit Kept(pybind11::object object)
      : object_(new pybind11::object(std::move(object)), [](pybind11::object* last) {
          if (!Py_IsInitialized()) return;
          const pybind11::gil_scoped_acquire lock;
          delete last;
        }) {}
  [[nodiscard]] const pybind11::object& get() const { return *object_; }

 private:
  std::shared_ptr<pybind11::object> object_;
};

/// "python model 'neo': ZeroDivisionError: division by zero (neo.py, line 12)": the last line of the traceback, and the
/// innermost place of it. With the lock.
std::string reason_of(const std::string& owner, pybind11::error_already_set& raised);

/// Calls Python with the lock; an exception becomes a failed evaluation.
template <class Call>
Status guarded_call(const std::string& owner, const Call& call) {
  const pybind11::gil_scoped_acquire lock;
  try {
    return call();
  } catch (pybind11::error_already_set& raised) {
    return Status::failed(reason_of(owner, raised));
  } catch (const std::exception& problem) {
    return Status::failed(owner + ": " + problem.what());
  }
}

/// The same for the making of an object, where it becomes an InputError.
template <class Call>
auto guarded_making(const std::string& owner, const Call& call) {
  const pybind11::gil_scoped_acquire lock;
  try {
    return call();
  } catch (pybind11::error_already_set& raised) {
    throw InputError(reason_of(owner, raised));
  }
}

/// The values of options as keyword arguments.
pybind11::dict keywords_of(const Options& options);

}  // namespace tunica::python
