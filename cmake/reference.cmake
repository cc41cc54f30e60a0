# Manual, completions and reference, made from the declarations in the code and from docs/*.md. Target: docs.
add_executable(declarations docs/generator/declarations.cpp)
target_link_libraries(declarations PRIVATE thermocontact_library)
target_compile_options(declarations PRIVATE -Wall -Wextra -Wconversion -Werror)

file(GLOB DOCUMENTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/*.md ${CMAKE_SOURCE_DIR}/docs/generator/*.py)
set(REFERENCE ${CMAKE_BINARY_DIR})
add_custom_command(
  OUTPUT ${REFERENCE}/declarations.json
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${REFERENCE}/man ${REFERENCE}/completions ${REFERENCE}/docs
  COMMAND declarations > ${REFERENCE}/declarations.json
  COMMAND ${FFCX_PYTHON} -B ${CMAKE_SOURCE_DIR}/docs/generator/reference.py ${REFERENCE}/declarations.json
          ${CMAKE_SOURCE_DIR}/docs ${REFERENCE}
  DEPENDS declarations ${DOCUMENTS}
  COMMENT "manual, completions, reference" VERBATIM)
add_custom_target(docs ALL DEPENDS ${REFERENCE}/declarations.json)

install(FILES ${REFERENCE}/man/thermocontact.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${REFERENCE}/man/thermocontact-scene.5 DESTINATION ${CMAKE_INSTALL_MANDIR}/man5 COMPONENT program)
install(FILES ${REFERENCE}/completions/thermocontact
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
set(ZSH_FOLDER site-functions)  # of what is not the distribution's
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(ZSH_FOLDER vendor-completions)
endif()
install(FILES ${REFERENCE}/completions/_thermocontact DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${ZSH_FOLDER}
        COMPONENT program)
install(FILES ${REFERENCE}/completions/thermocontact.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(DIRECTORY ${REFERENCE}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# The pictures of docs/gallery.md, made again in the sources
add_custom_target(gallery
  COMMAND ${FFCX_PYTHON} ${CMAKE_SOURCE_DIR}/verification/gallery.py --driver $<TARGET_FILE:thermocontact>
  COMMENT "pictures of the gallery" VERBATIM)
add_dependencies(gallery thermocontact)
