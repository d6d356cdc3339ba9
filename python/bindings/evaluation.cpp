// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "io/logs/undistorted_log.hpp"
#include "module.hpp"
#include "python_log.hpp"
#ifdef CCA_EVALUATION
#include "apps/logs/judged_map.hpp"
#endif

namespace cca::python {
namespace {

/// @param world  a .yaml; nothing: the records judge.
std::string judgeMap(const std::string& lines_csv, const std::string& name, nb::handle records,
                     const std::optional<std::string>& world) {
#ifdef CCA_EVALUATION
  RepeatedLog repeated(records);
  try {
    const nb::gil_scoped_release others_may_run;
    const apps::JudgedMap map(lines_csv, name);
    if (world) return apps::textOf(apps::judgeByWorld(*world, map));
    const auto log = undistortedLog([&] { return repeated.open(); }, std::nullopt);
    return apps::textOf(apps::judgeByLog(*log, map));
  } catch (const std::runtime_error& error) {
    throw nb::value_error(error.what());
  }
#else
  (void)lines_csv, (void)name, (void)records, (void)world;
  throw std::runtime_error("evaluate: this package was built without nanoflann (libnanoflann-dev)");
#endif
}

}  // namespace

void addEvaluation(nb::module_& module) {
  module.def("judge_map", &judgeMap, nb::arg("lines_csv"), nb::arg("name"), nb::arg("records"),
             nb::arg("world").none(),
             nb::sig("def judge_map(lines_csv: str, name: str, records: "
                     "collections.abc.Iterable[LogRecord], world: str | None) -> str"),
             "Figures of a map as JSON: see `cca_mrpt.evaluate`.");
}

}  // namespace cca::python
