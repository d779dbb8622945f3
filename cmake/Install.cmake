# `cmake --install`: the two programs, side by side as they expect it; the library with its headers; the package for find_package(smopt).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/smopt)

install(TARGETS smopt_program smopt_tetgen_worker RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS smopt EXPORT smoptTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/smopt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h"
        PATTERN cli EXCLUDE PATTERN parallel.h EXCLUDE PATTERN guarded_sweeper.h EXCLUDE
        PATTERN tile_sweep.h EXCLUDE)  # used inside only: users need not have TBB's headers
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT smoptTargets NAMESPACE smopt:: DESTINATION ${package_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/smoptConfig.cmake.in ${PROJECT_BINARY_DIR}/package/smoptConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/smoptConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/smoptConfig.cmake ${PROJECT_BINARY_DIR}/package/smoptConfigVersion.cmake
        DESTINATION ${package_folder})
