# tyndall_shaders(TARGET file.comp...)
# Compiles each compute shader to SPIR-V and embeds it: an object library whose header
# "spirv/NAME.h" holds the words as `const uint32_t NAME_spirv[]`. Depfiles make an edit of an
# included header rebuild what includes it; a shader error fails the build at that file.
find_program(TYNDALL_GLSLANG glslangValidator REQUIRED)

function(tyndall_shaders target)
  set(headers)
  foreach(source ${ARGN})
    get_filename_component(name ${source} NAME_WE)
    get_filename_component(path ${source} ABSOLUTE)
    set(header ${CMAKE_CURRENT_BINARY_DIR}/${target}/spirv/${name}.h)
    add_custom_command(
      OUTPUT ${header}
      DEPFILE ${header}.d
      DEPENDS ${path}
      COMMAND ${TYNDALL_GLSLANG} --quiet --target-env vulkan1.1 -I${PROJECT_SOURCE_DIR}/shaders
              -I${CMAKE_CURRENT_BINARY_DIR}
              --depfile ${header}.d --vn ${name}_spirv -o ${header} ${path}
      COMMENT "Compiling shader ${name}"
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  add_custom_target(${target}_headers DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/${target})
endfunction()
