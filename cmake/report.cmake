# How do I know it is right? One page, a quarter of an hour
add_custom_target(report
  COMMAND ${FFCX_PYTHON} ${CMAKE_SOURCE_DIR}/verification/report.py --driver $<TARGET_FILE:thermocontact>
          --output ${CMAKE_BINARY_DIR}/report
  COMMENT "report of the verification" USES_TERMINAL VERBATIM)
add_dependencies(report thermocontact manufactured)
