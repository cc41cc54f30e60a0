# The libraries without a CMake package of their own that thermocontact links with, as targets thermocontact::NAME. It
# stands beside the installed package, too, so that they are found where it is used as they were where it was built.
# What is missing: thermocontact_missing.
find_package(PkgConfig QUIET)
set(thermocontact_missing)

macro(thermocontact_module name module)
  if(NOT TARGET PkgConfig::${name})
    pkg_check_modules(${name} IMPORTED_TARGET GLOBAL ${module})
    if(NOT ${name}_FOUND)
      list(APPEND thermocontact_missing ${module})
    endif()
  endif()
endmacro()

# Target NAME of the library FILE; more arguments are those of find_library().
macro(thermocontact_library_file name file)
  find_library(THERMOCONTACT_LIBRARY_${name} ${file} ${ARGN})
  mark_as_advanced(THERMOCONTACT_LIBRARY_${name})
  if(NOT THERMOCONTACT_LIBRARY_${name})
    list(APPEND thermocontact_missing ${file})
  elseif(NOT TARGET thermocontact::${name})
    add_library(thermocontact::${name} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(thermocontact::${name} PROPERTIES IMPORTED_LOCATION ${THERMOCONTACT_LIBRARY_${name}})
  endif()
endmacro()

thermocontact_module(TOMLPLUSPLUS tomlplusplus)
thermocontact_module(MUPARSER muparser)
# HDF5's static library, as the shared one of Debian brings curl, TLS and LDAP along: 6 ms of every start. Its symbols
# stay hidden from PETSc, which brings the parallel HDF5 of its own.
pkg_check_modules(HDF5 QUIET hdf5-serial)
thermocontact_library_file(hdf5 libhdf5.a PATHS ${HDF5_LIBRARY_DIRS} NO_DEFAULT_PATH)
if(TARGET thermocontact::hdf5 AND HDF5_VERSION VERSION_GREATER_EQUAL 1.14)
  # its start names every driver, that of remote objects too
  set_target_properties(thermocontact::hdf5 PROPERTIES INTERFACE_LINK_LIBRARIES "curl;crypto")
endif()
thermocontact_library_file(szip sz)
thermocontact_library_file(cholmod cholmod)
thermocontact_library_file(suitesparseconfig suitesparseconfig)
thermocontact_library_file(metis metis)
