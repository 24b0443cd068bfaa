#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <string>

#include "framework/base/error.hpp"

namespace croon::python {

namespace py = pybind11;

/// Holds the interpreter's lock (GIL) while it lives; may be nested. A thread that asks for it
/// while the interpreter ends never gets it: it waits until the process is gone.
class WithGil {
 public:
  WithGil();
  ~WithGil();
  WithGil(const WithGil&) = delete;
  WithGil& operator=(const WithGil&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Lets other threads have the interpreter's lock while it lives.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;
};

/// Called when the interpreter is about to end, with its lock: waits for threads that are inside
/// Python code, and lets no other enter it.
void end_python();

/// A Python object that C++ code holds. It may be copied and released on any thread, with or
/// without the interpreter's lock. An object that outlives the interpreter is never released.
class ObjectRef {
 public:
  ObjectRef() = default;
  explicit ObjectRef(py::object object);

  /// The object; needs the lock.
  py::object get() const;
  explicit operator bool() const { return object_ != nullptr; }

 private:
  std::shared_ptr<PyObject> object_;
};

/// While it lives, a Python exception that becomes a StageError on this thread is kept here, to be
/// the cause of the exception that the caller gets.
class CauseOfFailure {
 public:
  CauseOfFailure();
  ~CauseOfFailure();
  CauseOfFailure(const CauseOfFailure&) = delete;
  CauseOfFailure& operator=(const CauseOfFailure&) = delete;

  ObjectRef exception;
  std::string message;  ///< Of the StageError that it became, which C++ may have handled since.

 private:
  CauseOfFailure* outer_;
};

/// Throws what the Python exception `error` is for the code that called Python: a StageError with
/// its message; `error` itself if it is KeyboardInterrupt, SystemExit or MemoryError, which end a
/// run.
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
    throw StageError(error.what());  // Of what the stage returned.
  } catch (const py::builtin_exception& error) {
    throw StageError(error.what());
  }
}

/// What str() of Python gives; empty if that raises an exception.
std::string text_of(const py::handle& object);

/// "a list", "a Step": the type of an object, for messages.
std::string type_words(const py::handle& object);

}  // namespace croon::python
