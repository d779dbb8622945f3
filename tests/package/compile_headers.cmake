# Installs, and compiles each header alone: it includes what it uses, and needs nothing but the standard library, Eigen and smopt's own.
include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)

set(prefix ${FOLDER}/prefix)
install_into(${prefix})
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*.h)
foreach(folder geometry improve io mesh surface)
  expect_match("${headers}" "smopt/${folder}/" "the headers of smopt/${folder}")
endforeach()
expect_no_match("${headers}" "cli/|metrics/|baselines/|experiments/" "no header of the program, the judge or the harness")
foreach(header ${headers})
  file(STRINGS ${prefix}/include/${header} includes REGEX "^#include")
  foreach(include ${includes})
    expect_match("${include}" "^#include (<[a-z_0-9]+>|<Eigen/[A-Za-z]+>|\"smopt/[a-z_0-9/]+[.]h\")$"
                 "only the standard library, Eigen and smopt's own in ${header}")
  endforeach()
endforeach()

# Nothing is linked or run: no sanitizer, no optimiser.
set(SANITIZE)
set(BUILD_TYPE)
build_project(${CMAKE_CURRENT_LIST_DIR}/headers ${FOLDER}/build ${prefix})
file(REMOVE_RECURSE ${prefix})
