#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>

#include "experiments/python/interpreter.hpp"

namespace croon::python {

/// Ends an interrupted run; the interpreter has the reason.
struct Interrupted : std::exception {};

/// Calls `work(check)` on another thread while this one checks for signals, such as Ctrl-C. After a
/// signal `check` throws, and the Python exception is raised when `work` has ended.
template <class Work>
void interruptible(const Work& work) {
  std::atomic<bool> is_interrupted{false};
  std::future<void> done = std::async(std::launch::async, [&] {
    work([&] {
      if (is_interrupted) throw Interrupted();
    });
  });
  std::unique_ptr<py::error_already_set> reason;
  {
    const WithoutGil no_gil;
    while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
      if (is_interrupted) continue;
      const WithGil gil;
      if (PyErr_CheckSignals() == 0) continue;
      reason = std::make_unique<py::error_already_set>();
      is_interrupted = true;
    }
  }
  try {
    done.get();
  } catch (const Interrupted&) {
  }
  if (reason) throw py::error_already_set(*reason);
}

}  // namespace croon::python
