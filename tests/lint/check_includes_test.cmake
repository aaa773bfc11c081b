# The tree obeys the include rules, and the check notices when one is broken.

function(check tree result)
  execute_process(COMMAND ${CMAKE_COMMAND} -DTREE=${tree} -P ${ROOT}/cmake/CheckIncludes.cmake
                  RESULT_VARIABLE status ERROR_VARIABLE errors)
  if(result STREQUAL pass AND NOT status EQUAL 0)
    message(SEND_ERROR "${errors}")
  elseif(result STREQUAL fail AND status EQUAL 0)
    message(SEND_ERROR "not noticed: ${ARGN}")
  endif()
endfunction()

check(${ROOT} pass)

# Each line is a file and what it may not hold.
set(forbidden
  "src/core/a.h|#include \"scene/scene.h\""
  "src/scene/a.cpp|#include \"shared/records.h\""
  "src/scene/a.cpp|#include \"image/image.h\""
  "src/gpu/a.cpp|#include \"render/effects.h\""
  "src/gpu/a.cpp|#include \"shared/records.h\""
  "src/render/a.cpp|#include <volk.h>"
  "src/render/a.cpp|#include <vulkan/vulkan.h>"
  "src/render/a.cpp|#include \"cli/options.h\""
  "src/reference/a.cpp|#include \"shared/records.h\""
  "src/reference/a.cpp|#include \"lib/phase.glsl\""
  "src/reference/a.cpp|#include \"gpu/context.h\""
  "src/stats/a.cpp|#include <OpenImageIO/imageio.h>"
  "src/study/a.cpp|#include \"cli/options.h\""
  "src/study/a.cpp|#include \"reference/reference.h\""
  "src/main.cpp|#include \"render/renderer.h\""
  "src/novel/a.cpp|int x"
  "shaders/shared/a.h|#include \"lib/phase.glsl\""
  "shaders/lib/a.glsl|#include \"wavefront/scene.glsl\""
  "shaders/lib/a.glsl|layout(binding = 0) buffer A"
  "shaders/wavefront/a.comp|#include \"wavefront/b.comp\"")
foreach(case ${forbidden})
  string(REGEX MATCH "^([^|]*)\\|(.*)$" _ "${case}")
  set(file ${CMAKE_MATCH_1})
  set(line "${CMAKE_MATCH_2}")
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/src/main.cpp "#include \"cli/options.h\"\n#include <cstdio>\n")
  file(WRITE ${SCRATCH}/src/image/a.cpp "#include <OpenImageIO/imageio.h>\n")
  check(${SCRATCH} pass)
  file(WRITE ${SCRATCH}/${file} "${line}\n")
  check(${SCRATCH} fail ${file}: ${line})
endforeach()
