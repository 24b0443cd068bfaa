#pragma once

#include <pybind11/numpy.h>

#include <functional>
#include <vector>

#include "framework/table/table.hpp"

namespace croon::python {

/// Collects the rows of a table in a structured array: a field per column, named as in CSV files.
/// Text has the type str; numbers, counts and truth values are float64, int64 or bool. If a row has
/// no value, its column is float64 with NaN, or for text contains an empty string, or "all" where
/// an empty value means all. Rows may be added without the interpreter's lock.
class ArrayOfRows {
 public:
  void add(const CellRow& row);
  /// The array of the rows so far, which have these columns. Requires the lock.
  pybind11::object array(const std::vector<Column>& columns) const;

 private:
  std::vector<std::vector<Value>> columns_;
};

}  // namespace croon::python
