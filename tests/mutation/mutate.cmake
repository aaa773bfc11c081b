# Plausible wrong lines, each of which some test must catch. The table is mutations.json: file, exact
# text, what it becomes, and the tests (program and GoogleTest filter) that must fail then.
#
#   cmake -DMODE=check -DROOT=tree -P mutate.cmake
#       Checks that each text still occurs exactly once, so that the table cannot rot.
#   cmake -DMODE=run -DROOT=tree -DSCRATCH=folder [-DONLY=regex] -P mutate.cmake
#       Copies the tree to the folder, builds the programs, and runs all those tests, which must
#       pass. Then applies one mutation at a time to the copy, builds the program, runs the tests,
#       and expects them to fail. Prints the table; fails if a mutation survives.
cmake_minimum_required(VERSION 3.25)
file(READ ${CMAKE_CURRENT_LIST_DIR}/mutations.json table)
string(JSON count LENGTH "${table}" mutations)
math(EXPR last "${count} - 1")

# Sets name, file, old, new, program and tests to those of mutation i.
macro(load_mutation i)
  foreach(key name file old new program tests)
    string(JSON ${key} GET "${table}" mutations ${i} ${key})
  endforeach()
endmacro()

# Sets `out` to how often the text occurs in the string.
function(count_occurrences string text out)
  string(LENGTH "${text}" length)
  set(found 0)
  string(FIND "${string}" "${text}" at)
  while(at GREATER_EQUAL 0)
    math(EXPR found "${found} + 1")
    math(EXPR at "${at} + ${length}")
    string(SUBSTRING "${string}" ${at} -1 string)
    string(FIND "${string}" "${text}" at)
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

function(check_table)
  foreach(i RANGE ${last})
    load_mutation(${i})
    file(READ ${ROOT}/${file} source)
    count_occurrences("${source}" "${old}" found)
    if(NOT found EQUAL 1)
      message(SEND_ERROR "mutation \"${name}\": its text occurs ${found} times in ${file}, not once")
    endif()
  endforeach()
  count_occurrences("one, two, one" "one" found) # the control
  if(count LESS 20 OR NOT found EQUAL 2)
    message(SEND_ERROR "${count} mutations, and ${found} of 2 found")
  endif()
endfunction()

# Builds the program in the copy; stops if it does not compile.
function(build program)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${SCRATCH}/build --target ${program}
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${program} does not compile:\n${output}")
  endif()
endfunction()

# Runs the tests; sets `out` to their status. A test that hangs has failed.
function(run_tests program tests out)
  file(GLOB_RECURSE path ${SCRATCH}/build/tests/${program})
  execute_process(COMMAND ${path} --gtest_filter=${tests} --gtest_brief=1 TIMEOUT 600
    OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE status)
  set(${out} ${status} PARENT_SCOPE)
endfunction()

function(run_baseline)
  foreach(folder cmake scenes shaders src tests)
    file(COPY ${ROOT}/${folder} DESTINATION ${SCRATCH}/tree)
  endforeach()
  file(COPY ${ROOT}/CMakeLists.txt DESTINATION ${SCRATCH}/tree)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SCRATCH}/tree -B ${SCRATCH}/build -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DTYNDALL_BENCHMARKS=OFF OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  foreach(i RANGE ${last})
    load_mutation(${i})
    if(NOT name MATCHES "${ONLY}")
      continue()
    endif()
    build(${program})
    run_tests(${program} "${tests}" status)
    if(NOT status EQUAL 0)
      message(FATAL_ERROR "without any mutation ${tests} of ${program} fails")
    endif()
  endforeach()
endfunction()

function(run_mutations)
  set(survivors)
  foreach(i RANGE ${last})
    load_mutation(${i})
    if(NOT name MATCHES "${ONLY}")
      continue()
    endif()
    file(READ ${ROOT}/${file} source)
    string(REPLACE "${old}" "${new}" mutant "${source}")
    string(TIMESTAMP start %s)
    file(WRITE ${SCRATCH}/tree/${file} "${mutant}")
    build(${program})
    run_tests(${program} "${tests}" status)
    file(WRITE ${SCRATCH}/tree/${file} "${source}")
    string(TIMESTAMP end %s)
    math(EXPR seconds "${end} - ${start}")
    if(status EQUAL 0)
      set(verdict "SURVIVES")
      list(APPEND survivors "${name}")
    else()
      set(verdict "caught")
    endif()
    message(STATUS "${verdict}: ${name} (${file}) by ${tests}, ${seconds} s")
  endforeach()
  if(survivors)
    list(JOIN survivors "\n  " survivors)
    message(FATAL_ERROR "mutations that no test has caught:\n  ${survivors}")
  endif()
endfunction()

check_table()
if(MODE STREQUAL run)
  run_baseline()
  run_mutations()
endif()
