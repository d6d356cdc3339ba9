// SPDX-License-Identifier: BSD-3-Clause
#include "line_arrays.hpp"

#include <nanobind/ndarray.h>

#include <cstring>
#include <memory>
#include <utility>

#include "owned_array.hpp"

namespace cca::python {
namespace {

struct LineRecord {
  double ends[4], covariance[4], returns;
};
struct MapLineRecord {
  std::uint64_t id;
  LineRecord line;
};

// Looked up once: they live as long as the interpreter does.
PyObject *new_array = nullptr, *line_type = nullptr, *map_line_type = nullptr;

LineRecord record(const LineSegment& line, double returns) {
  const Eigen::Matrix2d& c = line.covariance;
  return {{line.start.x(), line.start.y(), line.end.x(), line.end.y()},
          {c(0, 0), c(0, 1), c(1, 0), c(1, 1)},
          returns};
}
LineRecord record(const LineSegment& line) { return record(line, line.moments.weight); }
MapLineRecord record(const MapLine& line) { return {line.id, record(line.segment, line.support)}; }

template <class Record, class Line>
nb::object arrayOf(const std::vector<Line>& lines, PyObject* type) {
  const auto size = static_cast<Py_ssize_t>(lines.size() * sizeof(Record));
  const nb::object memory = nb::steal(PyByteArray_FromStringAndSize(nullptr, size));
  if (!memory.is_valid()) throw nb::python_error();
  char* to = PyByteArray_AsString(memory.ptr());
  for (const Line& line : lines) {
    const Record filled = record(line);
    std::memcpy(to, &filled, sizeof filled);
    to += sizeof filled;
  }
  return nb::handle(new_array)(lines.size(), nb::handle(type), memory);
}

}  // namespace

void addLineTypes(nb::module_& module) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const auto field = [](const char* name, const char* type, auto... shape) {
    return nb::make_tuple(name, type, nb::make_tuple(shape...));
  };
  nb::list fields;
  fields.append(field("ends", "<f8", 2, 2));
  fields.append(field("covariance", "<f8", 2, 2));
  fields.append(nb::make_tuple("returns", "<f8"));
  const nb::object line = numpy.attr("dtype")(fields);
  fields.insert(0, nb::make_tuple("id", "<u8"));
  const nb::object map_line = numpy.attr("dtype")(fields);
  module.attr("LINE") = line;
  module.attr("MAP_LINE") = map_line;
  new_array = nb::object(numpy.attr("ndarray")).release().ptr();
  line_type = nb::object(line).release().ptr();
  map_line_type = nb::object(map_line).release().ptr();
}

nb::object lineArray(const std::vector<LineSegment>& lines) {
  return arrayOf<LineRecord>(lines, line_type);
}
nb::object lineArray(const std::vector<MapLine>& lines) {
  return arrayOf<MapLineRecord>(lines, map_line_type);
}

nb::object pointArray(const std::vector<Eigen::Vector2d>& points) {
  auto numbers = std::make_unique<double[]>(2 * points.size() + 1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    numbers[2 * k] = points[k].x();
    numbers[2 * k + 1] = points[k].y();
  }
  return ownedArray(std::move(numbers), points.size(), 2);
}

}  // namespace cca::python
