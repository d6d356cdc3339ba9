// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace cca::python {

/// Each adds the classes and functions of one layer to the module.
void addMapping(nanobind::module_& module);
void addBaselines(nanobind::module_& module);
void addNavigation(nanobind::module_& module);
void addLocalisation(nanobind::module_& module);
void addLogs(nanobind::module_& module);
void addSlam(nanobind::module_& module);
void addMapFiles(nanobind::module_& module);
void addEvaluation(nanobind::module_& module);
void addFloorPlan(nanobind::module_& module);
void addSession(nanobind::module_& module);

}  // namespace cca::python
