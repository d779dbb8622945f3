# What the scripts of this folder share. Variables from the command line: BUILD and SOURCE of the project, FOLDER to work in; GENERATOR, COMPILER,
# LAUNCHER, BUILD_TYPE, FLAGS and SANITIZE (may be empty) as the project was configured.
cmake_minimum_required(VERSION 3.25)

# run(<command> ...): its output is in `output`; a failure ends the script.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${code}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect_match text regex what)
  if(NOT "${text}" MATCHES "${regex}")
    message(FATAL_ERROR "Expected: ${what}. Got:\n${text}")
  endif()
endfunction()

function(expect_no_match text regex what)
  if("${text}" MATCHES "${regex}")
    message(FATAL_ERROR "Expected: ${what}. Got:\n${CMAKE_MATCH_0}")
  endif()
endfunction()

function(install_into prefix)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
endfunction()

# Configures and builds a project in `source` that finds smopt in `prefix` and nowhere else.
function(build_project source build prefix)
  set(link_flags)
  if(SANITIZE)
    set(FLAGS "${FLAGS} -fsanitize=${SANITIZE} -fno-sanitize-recover=all")
    set(link_flags -fsanitize=${SANITIZE})
  endif()
  run(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER}
      -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_FLAGS=${FLAGS}
      -DCMAKE_EXE_LINKER_FLAGS=${link_flags} -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON --warn-uninitialized)
  run(${CMAKE_COMMAND} --build ${build})
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
