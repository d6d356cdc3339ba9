# find_package(cca_mrpt [COMPONENTS mapping navigation baselines simulation io])
#
# The targets cca_mrpt::mapping, ::navigation and ::baselines need Eigen only; ::simulation and ::io
# are there when they are asked for as components, and bring MRPT with them.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
include(${cca_mrpt_DIR}/cca_mrpt_eigen.cmake)
foreach(component ${cca_mrpt_FIND_COMPONENTS})
  if(component MATCHES "^(simulation|io)$" AND NOT TARGET cca_mrpt::simulation)
    find_dependency(MRPT COMPONENTS maps obs slam gui opengl io img)
    include(${cca_mrpt_DIR}/cca_mrpt_mrpt.cmake OPTIONAL)
  endif()
  if(TARGET cca_mrpt::${component})
    set(cca_mrpt_${component}_FOUND TRUE)
  elseif(cca_mrpt_FIND_REQUIRED_${component})
    set(cca_mrpt_FOUND FALSE)
    set(cca_mrpt_NOT_FOUND_MESSAGE "cca_mrpt has no component ${component}")
  endif()
endforeach()
