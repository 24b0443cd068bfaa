#include "experiments/python/interpreter.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace croon::python {
namespace {

/// Set when the interpreter is about to shut down.
std::atomic<bool> is_ending{false};
/// Threads that wait for the lock, or hold it through a WithGil.
std::atomic<int> threads_inside{0};
/// The number of nested WithGil objects in this thread.
thread_local int depth = 0;
thread_local CauseOfFailure* innermost_cause = nullptr;

/// Counts this thread as being inside Python. Never returns during shutdown of the interpreter:
/// acquiring its lock would then terminate the thread inside C++ code, and the process with it.
void enter() {
  if (depth > 0) return;
  ++threads_inside;
  if (!is_ending) return;
  --threads_inside;
  for (;;) ::pause();
}

void leave() {
  if (depth == 0) --threads_inside;
}

void release(PyObject* object) {
  if (object == nullptr || (is_ending && depth == 0) || Py_IsInitialized() == 0) return;
  const WithGil gil;
  Py_DECREF(object);
}

}  // namespace

WithGil::WithGil() {
  enter();
  ++depth;
  state_ = PyGILState_Ensure();
}

WithGil::~WithGil() {
  PyGILState_Release(state_);
  --depth;
  leave();
}

WithoutGil::~WithoutGil() {
  enter();
  PyEval_RestoreThread(state_);
  leave();
}

void end_python() {
  is_ending = true;
  ++depth;  // This thread returns to Python and needs it until the end.
  const WithoutGil no_gil;
  constexpr int kMaxWaits = 500;
  for (int i = 0; i < kMaxWaits && threads_inside > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

ObjectRef::ObjectRef(py::object object) : object_(object.release().ptr(), release) {}

py::object ObjectRef::get() const { return py::reinterpret_borrow<py::object>(object_.get()); }

CauseOfFailure::CauseOfFailure() : outer_(innermost_cause) { innermost_cause = this; }
CauseOfFailure::~CauseOfFailure() { innermost_cause = outer_; }

void throw_from_python(py::error_already_set& error) {
  if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) throw;
  const py::object type = error.type();
  const bool is_stage_error = type.is(py::module_::import("croon._errors").attr("StageError"));
  const std::string name = text_of(type.attr("__name__"));
  const std::string text = text_of(error.value());
  std::string message = text;
  if (!is_stage_error) message = text.empty() ? name : name + ": " + text;
  if (innermost_cause != nullptr) {
    if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
    innermost_cause->exception = ObjectRef(error.value());
    innermost_cause->message = message;
  }
  throw StageError(message);
}

void warn(const std::vector<Fault>& notes) {
  constexpr py::ssize_t kCallerOfCroon = 2;
  for (const Fault& note : notes) {
    if (PyErr_WarnEx(PyExc_FutureWarning, note.line().c_str(), kCallerOfCroon) != 0) {
      throw py::error_already_set();
    }
  }
}

std::string text_of(const py::handle& object) {
  const auto text = py::reinterpret_steal<py::object>(PyObject_Str(object.ptr()));
  const auto bytes = py::reinterpret_steal<py::object>(
      text ? PyUnicode_AsEncodedString(text.ptr(), "utf-8", "backslashreplace") : nullptr);
  if (bytes) return py::cast<std::string>(bytes);
  PyErr_Clear();  // Its str() raised an exception.
  return "";
}

std::string type_words(const py::handle& object) {
  const std::string name = text_of(py::type::of(object).attr("__name__"));
  const bool has_vowel = std::string("aeiouAEIOU").find(name.front()) != std::string::npos;
  return (has_vowel ? "an " : "a ") + name;
}

}  // namespace croon::python
