# What CPack reads before it packs.
if(CPACK_THERMOCONTACT_NATIVE)
  message(FATAL_ERROR "this build uses all instructions of the machine that built it, and would not run on others: "
                      "cmake --workflow --preset package")
endif()
