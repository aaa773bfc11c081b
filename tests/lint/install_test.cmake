# `cmake --install` gives the program, which runs from there, and its man page.
file(REMOVE_RECURSE ${SCRATCH})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${SCRATCH}/bin/tyndall --version
                OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT version STREQUAL VERSION)
  message(SEND_ERROR "the installed program is version '${version}', not '${VERSION}'")
endif()
file(GLOB_RECURSE files RELATIVE ${SCRATCH} ${SCRATCH}/*)
if(NOT files STREQUAL "bin/tyndall;share/man/man1/tyndall.1")
  message(SEND_ERROR "installed: ${files}")
endif()
