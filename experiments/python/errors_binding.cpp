#include <filesystem>

#include "experiments/python/bindings.hpp"
#include "experiments/python/interpreter.hpp"

namespace croon::python {
namespace {

/// Raises croon.InputError with the faults as tuples (file, where, message).
void raise_input_error(const InputError& error) {
  py::list faults;
  for (const Fault& fault : error.faults()) {
    const auto text = [](const std::string& bytes) {
      return py::reinterpret_steal<py::object>(
          PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
    };
    faults.append(py::make_tuple(text(fault.file), text(fault.where), text(fault.message)));
  }
  const py::object type = py::module_::import("croon._errors").attr("InputError");
  PyErr_SetObject(type.ptr(), type(error.what(), faults).ptr());
}

void raise_stage_error(const StageError& error) {
  const py::object type = py::module_::import("croon._errors").attr("StageError");
  PyErr_SetObject(type.ptr(), type(error.what()).ptr());
}

}  // namespace

void bind_errors() {
  py::register_local_exception_translator(
      [](std::exception_ptr pointer) {  // NOLINT(performance-unnecessary-value-param): pybind11's.
        try {
          if (pointer) std::rethrow_exception(pointer);
        } catch (const InputError& error) {
          raise_input_error(error);
        } catch (const StageError& error) {
          raise_stage_error(error);
        } catch (const std::filesystem::filesystem_error& error) {
          raise_input_error(InputError(error.path1().string(), "", error.code().message()));
        }
      });
}

}  // namespace croon::python
