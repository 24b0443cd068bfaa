#pragma once

#include <pybind11/numpy.h>

#include <functional>
#include <vector>

#include "framework/table/table.hpp"

namespace croon::python {

/// Gathers the rows of a table as a structured array: a field per column, called as in CSV files.
/// Text is of type str; a number, count or verdict is float64, int64 or bool. In a column in which
/// a row has no value, they are float64 with NaN, and text is empty, or "all" where nothing stands
/// for all. Rows may be added without the interpreter's lock.
class ArrayOfRows {
 public:
  void add(const CellRow& row);
  /// The rows so far, whose columns these are. Needs the lock.
  pybind11::object array(const std::vector<Column>& columns) const;

 private:
  std::vector<std::vector<Value>> columns_;
};

}  // namespace croon::python
