#include "experiments/python/result_arrays.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace croon::python {
namespace {

namespace py = pybind11;

template <class T>
bool is_any(const std::vector<Value>& values) {
  return std::any_of(values.begin(), values.end(),
                     [](const Value& value) { return std::holds_alternative<T>(value); });
}

double number_of(const Value& value) {
  return std::visit(
      [](const auto& of_type) {
        using T = std::decay_t<decltype(of_type)>;
        if constexpr (std::is_arithmetic_v<T>) return static_cast<double>(of_type);
        return std::numeric_limits<double>::quiet_NaN();
      },
      value);
}

template <class T, class From>
py::array array_of(const std::vector<Value>& values, const From& from) {
  py::array_t<T> array(static_cast<py::ssize_t>(values.size()));
  std::transform(values.begin(), values.end(), array.mutable_data(), from);
  return array;
}

py::array text_array(const std::vector<Value>& values, const Column& column) {
  py::list texts;
  for (const Value& value : values) {
    const std::string* const text = std::get_if<std::string>(&value);
    texts.append(text != nullptr            ? py::str(*text)
                 : column.is_all_if_nothing ? py::str("all")
                                            : py::str(""));
  }
  return py::module_::import("numpy").attr("array")(texts, py::arg("dtype") = "U");
}

py::array array_of(const std::vector<Value>& values, const Column& column) {
  if (is_any<std::string>(values) || column.is_all_if_nothing) return text_array(values, column);
  const bool is_whole = !is_any<std::monostate>(values) && !is_any<double>(values);
  if (is_whole && is_any<bool>(values)) {
    return array_of<bool>(values, [](const Value& value) { return number_of(value) != 0.0; });
  }
  if (is_whole && is_any<long long>(values)) {
    return array_of<std::int64_t>(values, [](const Value& value) {
      const auto* const count = std::get_if<long long>(&value);
      return count != nullptr ? static_cast<std::int64_t>(*count) : 0;
    });
  }
  return array_of<double>(values, number_of);
}

}  // namespace

void ArrayOfRows::add(const CellRow& row) {
  columns_.resize(row.size());
  for (std::size_t k = 0; k < row.size(); ++k) columns_[k].push_back(row[k].value);
}

py::object ArrayOfRows::array(const std::vector<Column>& columns) const {
  py::list fields;
  py::list arrays;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const py::array values =
        array_of(k < columns_.size() ? columns_[k] : std::vector<Value>(), columns[k]);
    fields.append(py::make_tuple(columns[k].full_name(), values.dtype()));
    arrays.append(values);
  }
  const py::object numpy = py::module_::import("numpy");
  const py::object array =
      numpy.attr("empty")(columns_.empty() ? 0 : columns_.front().size(), fields);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    array[py::str(columns[k].full_name())] = arrays[k];
  }
  return array;
}

}  // namespace croon::python
