// SPDX-License-Identifier: BSD-3-Clause
#include "module.hpp"

#include "line_arrays.hpp"

NB_MODULE(_core, module) {
  module.doc() = "The C++ core of cca_mrpt; use the names that the package itself offers.";
  module.attr("version") = CCA_VERSION;
  cca::python::addLineTypes(module);
  cca::python::addMapping(module);
  cca::python::addBaselines(module);
  cca::python::addNavigation(module);
  cca::python::addLogs(module);
  cca::python::addSlam(module);
  cca::python::addMapFiles(module);
  cca::python::addFloorPlan(module);
  cca::python::addSession(module);
  cca::python::addLocalisation(module);
  cca::python::addEvaluation(module);
}
