# cmake -DTREE=folder -P CheckIncludes.cmake
# Fails, naming each place, on an include that the layering forbids:
#
#   core <- volume, phase <- scene    core <- image <- stats    core <- gpu
#   those <- render, reference <- study, selftest <- cli
#   shared <- lib <- wavefront <- selftest
#
# A folder may include what its line below matches, and system headers. The folders that may include
# a library's headers stand beside that library.
cmake_minimum_required(VERSION 3.25)

set(rules
  "src/core      | core/"
  "src/volume    | core/ volume/"
  "src/phase     | core/ phase/"
  "src/scene     | core/ volume/ phase/ scene/"
  "src/image     | core/ image/"
  "src/gpu       | core/ gpu/ shared/bindings.h shared/features.h"
  "src/render    | core/ volume/ phase/ scene/ image/ gpu/ stats/ render/ shared/ spirv/"
  "src/reference | core/ volume/ phase/ scene/ reference/ shared/random.h shared/sobol.h shared/health.h shared/interop.h"
  "src/stats     | core/ image/ stats/ shared/sample_histogram.h shared/schedule.h"
  "src/study     | core/ volume/ phase/ scene/ image/ gpu/ render/ stats/ study/ shared/records.h"
  "src/selftest  | core/ volume/ scene/ image/ gpu/ render/ selftest/ shared/ spirv/"
  "src/cli       | core/ volume/ phase/ scene/ image/ gpu/ render/ reference/ stats/ study/ selftest/ cli/ shared/schedule.h shared/health.h"
  "src/main.cpp  | core/ cli/"
  "shaders/shared    | health.h interop.h records.h sample_histogram.h"
  "shaders/lib       | shared/ lib/"
  "shaders/wavefront | shared/ lib/ wavefront/.*glsl fused_stages/"
  "shaders/selftest  | shared/ lib/ wavefront/scene.glsl")

set(libraries
  "volk.h vulkan/ spirv-tools/ | src/gpu"
  "OpenImageIO/   | src/image"
  "openvdb/ nanovdb/ | src/volume"
  "embree         | src/render src/reference"
  "openvdb nanovdb/ | src/volume"
  "CLI/           | src/cli"
  "nlohmann/      | src/core src/cli src/study")

set(failures)

# Sets `out` to the lines of the file that match, without what would split a list of CMake.
function(matching_lines file regex out)
  file(STRINGS ${file} lines REGEX "${regex}")
  string(REPLACE "[" "(" lines "${lines}")
  set(${out} "${lines}" PARENT_SCOPE)
endfunction()

function(check_folder folder allowed)
  string(REGEX REPLACE " +" "|" allowed "${allowed}")
  file(GLOB_RECURSE files ${TREE}/${folder}/*)
  if(EXISTS ${TREE}/${folder} AND NOT IS_DIRECTORY ${TREE}/${folder})
    set(files ${TREE}/${folder})
  endif()
  foreach(file ${files})
    matching_lines(${file} "^ *#include" lines)
    foreach(line ${lines})
      if(line MATCHES "\"(.*)\"" AND NOT CMAKE_MATCH_1 MATCHES "^(${allowed})")
        list(APPEND failures "${file}: ${line} (allowed: ${allowed})")
      endif()
      foreach(library ${libraries})
        string(REGEX MATCH "^([^|]*[^ |]) *\\| (.*)$" _ "${library}")
        string(REPLACE " " "|" headers "${CMAKE_MATCH_1}")
        string(REPLACE " " "|" users "${CMAKE_MATCH_2}")
        if(line MATCHES "<(${headers})" AND NOT folder MATCHES "^(${users})$")
          list(APPEND failures "${file}: ${line} (allowed in: ${users})")
        endif()
      endforeach()
    endforeach()
    if(folder STREQUAL shaders/lib)
      matching_lines(${file} "^ *layout *\\(" lines)
      foreach(line ${lines})
        list(APPEND failures "${file}: ${line} (shaders/lib declares no buffers)")
      endforeach()
    endif()
  endforeach()
  set(failures "${failures}" PARENT_SCOPE)
endfunction()

foreach(rule ${rules})
  string(REGEX MATCH "^([^ ]*) *\\| (.*)$" _ "${rule}")
  check_folder(${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()
file(GLOB folders RELATIVE ${TREE} ${TREE}/src/* ${TREE}/shaders/*)
foreach(folder ${folders})
  if(NOT folder MATCHES "CMakeLists.txt$" AND NOT "${rules}" MATCHES "${folder} ")
    list(APPEND failures "${folder}: no rule says what it may include")
  endif()
endforeach()

if(failures)
  list(JOIN failures "\n  " text)
  message(FATAL_ERROR "Includes that the layering forbids:\n  ${text}")
endif()
