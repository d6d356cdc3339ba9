// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/string.h>

#include "arguments.hpp"
#include "baselines/registry.hpp"
#include "line_arrays.hpp"
#include "module.hpp"

namespace cca::python {
namespace {

nb::object extractBy(const baselines::Baseline& baseline, nb::handle ranges, double angle_min,
                     double angle_increment, bool tuned) {
  Scan scan;
  readScan(ranges, angle_min, angle_increment, scan);
  std::vector<LineSegment> lines;
  {
    const nb::gil_scoped_release others_may_run;
    lines = (tuned ? baseline.tuned : baseline.recommended)(scan);
  }
  return lineArray(lines);
}

}  // namespace

void addBaselines(nb::module_& module) {
  nb::class_<baselines::Baseline>(module, "Baseline", "A classical line extractor.")
      .def_ro("name", &baselines::Baseline::name)
      .def_ro("paper", &baselines::Baseline::paper, "Where it was published.")
      .def("extract_lines", &extractBy, nb::arg("ranges").none(), nb::arg("angle_min"),
           nb::arg("angle_increment"), nb::arg("tuned") = false,
           nb::sig("def extract_lines(self, ranges: numpy.typing.ArrayLike, angle_min: float, "
                   "angle_increment: float, tuned: bool = False) -> "
                   "numpy.typing.NDArray[numpy.void]"),
           R"(Lines of one scan; arguments and result as in `cca_mrpt.extract_lines`.

Args:
    tuned: with the best values known for indoor scans, not those that its source recommends.)")
      .def("__repr__", [](const baselines::Baseline& baseline) {
        return "Baseline(" + baseline.name + ": " + baseline.paper + ")";
      });
  module.def(
      "all_baselines",
      [] {
        nb::list all;
        for (const baselines::Baseline& baseline : baselines::all())
          all.append(nb::cast(baseline, nb::rv_policy::reference));
        return all;
      },
      nb::sig("def all_baselines() -> list[Baseline]"), "In the order of the comparison.");
}

}  // namespace cca::python
