# Installs, builds the example against what was installed, and runs it beside the installed programs. With MOVED, the folder is moved first.
include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)

set(prefix ${FOLDER}/prefix)
if(MOVED)
  install_into(${FOLDER}/first)
  file(RENAME ${FOLDER}/first ${prefix})
else()
  install_into(${prefix})
endif()

# A copy, so that no path leads back to the project.
file(COPY ${SOURCE}/tests/package/example DESTINATION ${FOLDER})
build_project(${FOLDER}/example ${FOLDER}/build ${prefix})

file(READ ${FOLDER}/build/compile_commands.json commands)
expect_match("${commands}" "-isystem ${prefix}/include" "headers of the package")
expect_no_match("${commands}" "(-I|-isystem) *(${SOURCE}|${BUILD}) " "no headers of the project itself")
expect_no_match("${commands}" " -W(all|extra|error|conversion)" "the project's warnings stay in the project")
expect_match("${commands}" "-ffp-contract=off" "formulas in headers are not contracted")
if(NOT SANITIZE)
  expect_no_match("${commands}" "-fsanitize" "no sanitizer")
endif()

# Two atoms that touch: a surface of some thousand triangles.
file(WRITE ${FOLDER}/molecule.pqr "ATOM 1 C A 1 0.0 0.0 0.0 0.0 1.7\nATOM 2 O A 1 2.5 0.3 0.1 0.0 1.5\n")
run(${prefix}/bin/smopt generate ${FOLDER}/molecule.pqr -o ${FOLDER}/surface.off --spacing 0.3)

run(${FOLDER}/build/example ${FOLDER}/surface.off ${FOLDER}/improved.off)
expect_match("${output}" "smoothing: [0-9]+ %" "progress")
expect_match("${output}" "[1-9][0-9]* accepted, [0-9]+ refused, stopped because: [a-z]" "counts, and why it stopped")

# The same library behind both, and the same defaults.
run(${prefix}/bin/smopt improve ${FOLDER}/surface.off -o ${FOLDER}/by-program.off)
file(SHA256 ${FOLDER}/surface.off initial)
file(SHA256 ${FOLDER}/improved.off by_example)
file(SHA256 ${FOLDER}/by-program.off by_program)
expect_match(${by_example} ${by_program} "the example writes what the program writes")
expect_no_match(${by_example} ${initial} "a mesh that has changed")

run(${prefix}/bin/smopt measure --json ${FOLDER}/improved.off)
string(JSON pairs GET "${output}" intersecting_pairs)
string(JSON closed GET "${output}" closed)
expect_match("${pairs}" "^0$" "no intersecting pair")
expect_match("${closed}" "^(ON|true)$" "a closed surface")

# Its worker is found beside the program.
run(${prefix}/bin/smopt tetrahedralize ${FOLDER}/improved.off --json)
string(JSON status GET "${output}" status)
expect_match("${status}" "^success$" "a volume mesh by TetGen")

file(WRITE ${FOLDER}/broken.off "OFF\n3 1 0\n0 0 0\n1 0 0\n")
execute_process(COMMAND ${FOLDER}/build/example ${FOLDER}/broken.off ${FOLDER}/none.off ERROR_VARIABLE error RESULT_VARIABLE code)
expect_match("${code}" "^1$" "the error is caught")
expect_match("${error}" "broken.off:" "the error names the file")
if(EXISTS ${FOLDER}/none.off)
  message(FATAL_ERROR "Expected: nothing is written when the input is broken")
endif()

# Tens of megabytes that only a failure would need.
file(REMOVE_RECURSE ${prefix})
