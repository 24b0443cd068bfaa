#include "experiments/python/bindings.hpp"
#include "experiments/python/estimates.hpp"

namespace croon::python {
namespace {

std::uint64_t below(PythonRng& self, std::int64_t count) {
  if (count < 1) {
    throw InputError("", "count", "expected a positive number, found " + std::to_string(count));
  }
  return self.rng.below(static_cast<std::uint64_t>(count));
}

py::object numpy_generator(PythonRng& self) {
  const py::module_ random = py::module_::import("numpy.random");
  return random.attr("Generator")(random.attr("PCG64")(self.rng.bits()));
}

}  // namespace

void bind_rng(py::module_& module) {
  py::class_<PythonRng>(
      module, "Rng",
      "The random stream of a step of a trial: the same numbers in every run, on every machine.")
      .def(
          "bits", [](PythonRng& self) { return self.rng.bits(); }, "The next 64 bits.")
      .def(
          "uniform",
          [](PythonRng& self, double low, double high) { return self.rng.uniform(low, high); },
          py::arg("low") = 0.0, py::arg("high") = 1.0, "Uniform in [low, high).")
      .def("below", below, py::arg("count"), "Uniform in 0, ..., count - 1.")
      .def(
          "normal", [](PythonRng& self) { return self.rng.normal(); }, "Standard normal.")
      .def("numpy", numpy_generator,
           "A numpy.random.Generator that is seeded with the next 64 bits.");
}

}  // namespace croon::python
