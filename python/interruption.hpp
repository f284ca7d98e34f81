// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <utility>

namespace rovernet::python {

namespace py = pybind11;

/// Interruption of a simulation by Python: Ctrl-C, or an error in a callback. The simulation runs
/// without Python's lock (GIL), and calls go_on() repeatedly. After an interruption the caller of
/// the simulation raises the error in Python.
class Interruption {
  public:
    /// Whether the simulation may continue. Checks for Ctrl-C, and calls `look`, at most every
    /// 50 ms of real time.
    template <class Look>
    bool go_on(const Look& look) {
        constexpr std::chrono::milliseconds pause{50};
        if (error_) return false;
        const auto now = std::chrono::steady_clock::now();
        if (now - looked_ < pause) return true;
        looked_ = now;
        call([&] {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            look();
        });
        return !error_;
    }
    bool go_on() {
        return go_on([] {});
    }
    /// Calls a Python function, holding Python's lock; stores the error of a failed call.
    template <class Callback>
    void call(const Callback& callback) {
        const py::gil_scoped_acquire lock;
        is_calling_ = true;
        try {
            callback();
        } catch (...) {
            error_ = std::current_exception();
        }
        is_calling_ = false;
    }
    /// Whether a Python callback is running, during which the simulation stands still.
    bool is_calling() const { return is_calling_; }
    bool has_error() const { return error_ != nullptr; }
    /// Raises the error of a failed callback, once.
    void raise() {
        if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    }

  private:
    std::chrono::steady_clock::time_point looked_;
    std::exception_ptr error_;
    bool is_calling_ = false;
};

}  // namespace rovernet::python
