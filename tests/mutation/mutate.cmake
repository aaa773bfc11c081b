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
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${SCRATCH}/tree/build/release --target ${program} --parallel 2
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${program} does not compile:\n${output}")
  endif()
endfunction()

# Runs the tests; sets `out` to their status, which is not 0 if they hang, and `failure` to the first
# test that failed. That no test is of that name is an error.
function(run_tests program tests out failure)
  file(GLOB_RECURSE path ${SCRATCH}/tree/build/release/tests/${program})
  execute_process(COMMAND ${path} --gtest_filter=${tests} TIMEOUT 600
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT output MATCHES "Running [1-9]")
    message(FATAL_ERROR "${program} has no test ${tests}:\n${output}")
  endif()
  set(first "none, but ${status}")
  if(output MATCHES "\\[  FAILED  \\] ([^\n, ]+)")
    set(first ${CMAKE_MATCH_1})
  endif()
  set(${out} ${status} PARENT_SCOPE)
  set(${failure} ${first} PARENT_SCOPE)
endfunction()

function(copy_tree)
  foreach(folder cmake scenes shaders src tests)
    file(COPY ${ROOT}/${folder} DESTINATION ${SCRATCH}/tree)
  endforeach()
  file(COPY ${ROOT}/CMakeLists.txt DESTINATION ${SCRATCH}/tree)
  foreach(i RANGE ${last}) # a run that was ended may have left one mutated, and built
    load_mutation(${i})
    file(TOUCH ${SCRATCH}/tree/${file})
  endforeach()
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SCRATCH}/tree -B ${SCRATCH}/tree/build/release -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DTYNDALL_BENCHMARKS=OFF OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The control of all mutations: without one, the tests pass.
function(run_control)
  set(done)
  foreach(i RANGE ${last})
    load_mutation(${i})
    if(NOT name MATCHES "${ONLY}" OR "${program} ${tests}" IN_LIST done)
      continue()
    endif()
    list(APPEND done "${program} ${tests}")
    build(${program})
    run_tests(${program} "${tests}" status failure)
    if(NOT status EQUAL 0)
      message(FATAL_ERROR "without any mutation ${tests} of ${program} fails: ${failure}")
    endif()
  endforeach()
  message(STATUS "without any mutation, all tests pass")
endfunction()

# Applies mutation i, builds, tests, and takes it back. Sets `out` to a line of the table.
function(run_mutation i out)
  load_mutation(${i})
  file(READ ${SCRATCH}/tree/${file} source)
  string(REPLACE "${old}" "${new}" mutant "${source}")
  file(WRITE ${SCRATCH}/tree/${file} "${mutant}")
  build(${program})
  run_tests(${program} "${tests}" status failure)
  file(WRITE ${SCRATCH}/tree/${file} "${source}")
  if(status EQUAL 0)
    set(${out} "SURVIVES  ${name} (${file}): ${tests} passes" PARENT_SCOPE)
  else()
    set(${out} "caught    ${name} (${file}): ${failure}" PARENT_SCOPE)
  endif()
endfunction()

function(run_mutations)
  set(rows)
  foreach(i RANGE ${last})
    load_mutation(${i})
    if(name MATCHES "${ONLY}")
      run_mutation(${i} row)
      message(STATUS "${row}")
      string(APPEND rows "${row}\n")
    endif()
  endforeach()
  count_occurrences("${rows}" "caught  " caught)
  count_occurrences("${rows}" "SURVIVES  " survivors)
  message(NOTICE "\n${rows}\n${caught} caught, ${survivors} not")
  if(survivors GREATER 0)
    message(FATAL_ERROR "no test catches what survives")
  endif()
endfunction()

check_table()
if(MODE STREQUAL run)
  copy_tree()
  run_control()
  run_mutations()
endif()
