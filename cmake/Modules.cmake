# tyndall_module(NAME SOURCES file... DEPENDS target...)
# A static library tyndall_NAME with the project's warnings and sanitizers. The link graph of the
# modules is the rule of who may include whom; a module sees src/ and nothing else by itself.
function(tyndall_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-missing-field-initializers
    $<$<BOOL:${TYNDALL_WARNINGS_AS_ERRORS}>:-Werror>)
  if(TYNDALL_ASSERTIONS)
    target_compile_definitions(${target} PRIVATE TYNDALL_ASSERTIONS)
  endif()
  if(TYNDALL_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${TYNDALL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${TYNDALL_SANITIZE})
  endif()
endfunction()

function(tyndall_module name)
  cmake_parse_arguments(MODULE "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(tyndall_${name} STATIC ${MODULE_SOURCES})
  target_include_directories(tyndall_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(tyndall_${name} PUBLIC ${MODULE_DEPENDS} PRIVATE ${MODULE_PRIVATE_DEPENDS})
  tyndall_options(tyndall_${name})
endfunction()
