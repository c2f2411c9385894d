# `cpack --config build/release/CPackConfig.cmake` makes two Debian packages: the program with its examples, and what another CMake
# project needs of the libraries. What the program links with is found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Splashdown authors <splashdown@localhost>")  # Debian asks for an address
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME splashdown)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The one without threads, where there is a choice: scripts/packages.txt. MPI, which hypre starts, runs its daemon (orted) from the second.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libopenblas0-serial | libopenblas0, openmpi-bin")
# Reports are written without them, too: they lack the curves or the replay, and say so.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, libjs-dygraphs, libjs-three")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "chromium, ffmpeg, paraview")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME splashdown-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  g++ cmake pkg-config libbullet-dev libeigen3-dev libfftw3-dev libfmt-dev libgmp-dev libhypre-dev libmpfr-dev mpi-default-dev libopenblas0-serial
  libsuitesparse-dev libtbb-dev libtomlplusplus-dev nlohmann-json3-dev)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Light bodies landing on water
 Splashdown couples an incompressible fluid with a free surface, followed by
 the particle finite element method, with rigid bodies.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Light bodies landing on water: libraries
 Headers, static libraries and a CMake package for programs that drive
 Splashdown: scenes stepped by hand, or its solver without scenes.")
include(CPack)
