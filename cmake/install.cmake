# What is installed. Components: "program" for who runs scenes; "development" for who builds with the library.
include(CMakePackageConfigHelpers)
set(THERMOCONTACT_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/thermocontact)
set(THERMOCONTACT_DATA_DIR ${CMAKE_INSTALL_DATADIR}/thermocontact)

install(TARGETS thermocontact thermocontact-petsc RUNTIME COMPONENT program)
install(DIRECTORY scenes DESTINATION ${THERMOCONTACT_DATA_DIR} COMPONENT program
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.geo" PATTERN "*.msh")

# The library's interface is a class and what it throws: nothing in it depends on the headers, versions and compiler
# options that the library itself was compiled with.
foreach(header embed/scene_run.h error.h)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/thermocontact/${folder} COMPONENT development)
endforeach()
install(TARGETS thermocontact_library EXPORT thermocontactTargets ARCHIVE COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT thermocontactTargets NAMESPACE thermocontact:: DESTINATION ${THERMOCONTACT_PACKAGE_DIR}
        COMPONENT development)
configure_package_config_file(
  cmake/thermocontactConfig.cmake.in ${CMAKE_BINARY_DIR}/package/thermocontactConfig.cmake
  INSTALL_DESTINATION ${THERMOCONTACT_PACKAGE_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/thermocontactConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/thermocontactConfig.cmake
              ${CMAKE_BINARY_DIR}/package/thermocontactConfigVersion.cmake cmake/libraries.cmake
        DESTINATION ${THERMOCONTACT_PACKAGE_DIR} COMPONENT development)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
