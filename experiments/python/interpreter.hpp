#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon::python {

namespace py = pybind11;

/// Holds the interpreter's lock (GIL) during its lifetime; may be nested. A thread that requests
/// the lock during shutdown never gets it: it waits until the process ends.
class WithGil {
 public:
  WithGil();
  ~WithGil();
  WithGil(const WithGil&) = delete;
  WithGil& operator=(const WithGil&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Releases the interpreter's lock during its lifetime.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;
};

/// Called before shutdown of the interpreter, with its lock: waits for threads inside Python code,
/// and prevents others from entering it.
void end_python();

/// A Python object held by C++ code. It may be copied and released on any thread, with or without
/// the interpreter's lock. An object that outlives the interpreter is never released.
class ObjectRef {
 public:
  ObjectRef() = default;
  explicit ObjectRef(py::object object);

  /// The object; requires the lock.
  py::object get() const;
  explicit operator bool() const { return object_ != nullptr; }

 private:
  std::shared_ptr<PyObject> object_;
};

/// While it lives, records the Python exception of a StageError raised on this thread, to make it
/// the cause of the exception raised for the caller.
class CauseOfFailure {
 public:
  CauseOfFailure();
  ~CauseOfFailure();
  CauseOfFailure(const CauseOfFailure&) = delete;
  CauseOfFailure& operator=(const CauseOfFailure&) = delete;

  ObjectRef exception;
  std::string message;  ///< Message of the StageError, which C++ may have handled since.

 private:
  CauseOfFailure* outer_;
};

/// Converts the Python exception `error` for the code that called Python and throws it: a
/// StageError with its message, or `error` itself for KeyboardInterrupt, SystemExit and
/// MemoryError, which end a run.
[[noreturn]] void throw_from_python(py::error_already_set& error);

/// Calls `work`, which uses Python, with the interpreter's lock. Its result must not be a Python
/// object. A Python exception becomes a StageError, see `throw_from_python`.
template <class Work>
auto in_python(const Work& work) {
  const WithGil gil;
  try {
    return work();
  } catch (py::error_already_set& error) {
    throw_from_python(error);
  } catch (const InputError& error) {
    throw StageError(error.what());  // About the value returned by the stage.
  } catch (const py::builtin_exception& error) {
    throw StageError(error.what());
  }
}

/// Issues a FutureWarning for each note, at the caller of croon's function; requires the lock.
void warn(const std::vector<Fault>& notes);

/// The result of Python's str(); empty if it raises an exception.
std::string text_of(const py::handle& object);

/// The type of an object in words for messages: "a list", "a Step".
std::string type_words(const py::handle& object);

}  // namespace croon::python
