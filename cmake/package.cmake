# Debian packages: `cmake --workflow --preset package` makes them from a build for any machine of the architecture.
#
# Two packages. Who runs scenes needs the programs and shared libraries; who builds with the library needs the -dev packages
# of all that the static library links with, which would else come along for nothing. The program with PETSc
# is in the first one: "auto" may choose it, and without it a scene would run or not by its size.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME thermocontact)
set(THERMOCONTACT_MAINTAINER "thermocontact developers <thermocontact@invalid.example>"
    CACHE STRING "Name and address of who answers for the packages")
set(CPACK_PACKAGE_CONTACT ${THERMOCONTACT_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/cmake/package_check.cmake)
set(CPACK_THERMOCONTACT_NATIVE ${THERMOCONTACT_NATIVE})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME thermocontact)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libgmsh4.8, openmpi-bin")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
    "dynamic frictional contact of thermo-viscoelastic bodies
Finite elements for bodies that meet a rigid, heat-conducting foundation:
normal compliance, Coulomb friction, heat exchange. A scene is a file in
TOML; every step proves its balances of energy, force and heat.

Meshes of Gmsh are read with libgmsh; several processes are started by
mpirun, of openmpi-bin.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME thermocontact-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
       "cmake" "pkg-config" "libbasix-dev" "libhdf5-dev" "libmetis-dev" "libmuparser-dev" "libopenblas-dev | libblas-dev"
       "libsuitesparse-dev" "libtomlplusplus-dev" "zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "dynamic frictional contact of thermo-viscoelastic bodies - library
The static library of thermocontact, its header and its CMake package, for
programs that drive a scene step by step; with an example.")

include(CPack)
