// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <pybind11/pybind11.h>

#include "plugins/catalogue.hpp"

namespace tunica::python {

/// Runs and diagnoses of one process come one after the other: they share the handler of Ctrl-C. While this object
/// lives no other can be made; a second one throws InputError.
class OneAtATime {
 public:
  OneAtATime();
  ~OneAtATime();
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;
};

/// Tells a Python function how far something is, from any thread. What it raises interrupts as Ctrl-C does, and is
/// raised again by finish(). Made and finished with the interpreter's lock held; None tells nobody.
class Told {
 public:
  explicit Told(pybind11::object listener) : listener_(std::move(listener)) {}
  [[nodiscard]] std::function<void(double, const std::string&)> function();
  void finish();

 private:
  void tell(double share, const std::string& text);

  pybind11::object listener_;
  std::mutex mutex_;
  std::exception_ptr raised_;
};

/// The catalogue with tests that fail once Ctrl-C was pressed: what has no way out of its own then ends soon.
plugins::Catalogue interruptible(const plugins::Catalogue& catalogue);

}  // namespace tunica::python
