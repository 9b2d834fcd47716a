# What `cmake --install` puts where, and the Debian package (`cpack`). Programs find each other beside themselves: they live in one folder,
# and bin/ holds a link to the one that people call; names as general as `fluid` and `solid` stay out of the path.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # the target `programs` is enough
set(programs_dir ${CMAKE_INSTALL_LIBEXECDIR}/tether)
set(share_dir ${CMAKE_INSTALL_DATADIR}/tether)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tether)

install(TARGETS tether fluid solid fsi_master identification_master observation_manager tether_picture tether_conform
  RUNTIME DESTINATION ${programs_dir})
install(TARGETS tether_petsc LIBRARY DESTINATION ${programs_dir})
file(RELATIVE_PATH program_from_bin /${CMAKE_INSTALL_BINDIR} /${programs_dir}/tether)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/link)
file(CREATE_LINK ${program_from_bin} ${PROJECT_BINARY_DIR}/link/tether SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/link/tether DESTINATION ${CMAKE_INSTALL_BINDIR})

# Codes of one's own: tether.h, its library, find_package(Tether) with the target Tether::client, the Python modules.
install(TARGETS tether_client EXPORT TetherTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES client/tether.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT TetherTargets NAMESPACE Tether:: DESTINATION ${package_dir})
file(WRITE ${PROJECT_BINARY_DIR}/TetherConfig.cmake "include(\${CMAKE_CURRENT_LIST_DIR}/TetherTargets.cmake)\n")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TetherConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TetherConfig.cmake ${PROJECT_BINARY_DIR}/TetherConfigVersion.cmake DESTINATION ${package_dir})
install(DIRECTORY tools/python/ DESTINATION lib/python3/dist-packages PATTERN __pycache__ EXCLUDE)

install(DIRECTORY configs DESTINATION ${share_dir} USE_SOURCE_PERMISSIONS)  # programs of cases
install(PROGRAMS tools/cine_mr_contours.py tools/end_diastolic_contours.py DESTINATION ${share_dir}/tools)
install(FILES README.md CONTRIBUTING.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} USE_SOURCE_PERMISSIONS)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Tether developers <tether@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, xvfb, libgl1-mesa-dri, python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-mpi4py, libopenmpi-dev, paraview")
include(CPack)
