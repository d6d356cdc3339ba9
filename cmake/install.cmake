# Install rules and the CMake export. A build with ROS has one package configuration, catkin's, which
# includes cca_mrpt-extras.cmake; without ROS that same file is the package configuration.
include(CMakePackageConfigHelpers)
if(CCA_ROS)
  set(config_dir share/cca_mrpt/cmake)
  set(export_dir ${CATKIN_DEVEL_PREFIX}/share/cca_mrpt/cmake)
  if(CCA_INSTALLS_SETUP)
    set(setup_dir ${CMAKE_CURRENT_BINARY_DIR}/catkin_generated/installspace)
    file(WRITE ${setup_dir}/.catkin "")
    foreach(setup .catkin setup.sh setup.bash setup.zsh local_setup.sh local_setup.bash local_setup.zsh)
      #catkin_lint: ignore_once wrong_install_destination missing_file (catkin makes them)
      install(FILES ${setup_dir}/${setup} DESTINATION .)
    endforeach()
    #catkin_lint: ignore_once wrong_bin_install_destination wrong_install_destination external_file missing_file
    install(PROGRAMS ${CATKIN_DEVEL_PREFIX}/_setup_util.py DESTINATION .)
  endif()
else()
  set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cca_mrpt)
  set(export_dir ${CMAKE_CURRENT_BINARY_DIR})
  #catkin_lint: ignore_once wrong_install_destination (this branch is the build without catkin)
  install(FILES cmake/cca_mrpt-extras.cmake DESTINATION ${config_dir} RENAME cca_mrptConfig.cmake)
  write_basic_package_version_file(cca_mrptConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  #catkin_lint: ignore_once wrong_install_destination missing_file
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/cca_mrptConfigVersion.cmake DESTINATION ${config_dir})
endif()

# The Eigen-only layers stand in an export of their own, so that using them needs no MRPT.
set(eigen_layers cca_mapping cca_navigation cca_baselines)
set(mrpt_layers cca_evaluation cca_simulation cca_io cca_evidence)
if(NOT CCA_WITH_MRPT)
  set(mrpt_layers "")
endif()
foreach(kind eigen mrpt)
  if(${kind}_layers)
    #catkin_lint: ignore_once undefined_target (cca_layer() defines them)
    install(TARGETS ${${kind}_layers} EXPORT cca_mrpt_${kind}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT cca_mrpt_${kind} NAMESPACE cca_mrpt:: DESTINATION ${config_dir})
    export(EXPORT cca_mrpt_${kind} NAMESPACE cca_mrpt:: FILE ${export_dir}/cca_mrpt_${kind}.cmake)
  endif()
endforeach()

install(DIRECTORY include/cca_mrpt DESTINATION include)
install(DIRECTORY maps DESTINATION share/cca_mrpt)
