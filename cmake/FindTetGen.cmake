# TetGen as a library: target TetGen::TetGen (Debian: libtet1.5-dev).
find_path(TETGEN_INCLUDE_DIR tetgen.h)
find_library(TETGEN_LIBRARY NAMES tet tetgen)
# The header has no version; the library's file name does.
file(REAL_PATH "${TETGEN_LIBRARY}" tetgen_file)
string(REGEX MATCH "[0-9][0-9.]*$" TetGen_VERSION "${tetgen_file}")
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TetGen REQUIRED_VARS TETGEN_LIBRARY TETGEN_INCLUDE_DIR)
if(TetGen_FOUND AND NOT TARGET TetGen::TetGen)
  add_library(TetGen::TetGen UNKNOWN IMPORTED)
  set_target_properties(TetGen::TetGen PROPERTIES IMPORTED_LOCATION ${TETGEN_LIBRARY}
                                                  INTERFACE_INCLUDE_DIRECTORIES ${TETGEN_INCLUDE_DIR})
endif()
mark_as_advanced(TETGEN_INCLUDE_DIR TETGEN_LIBRARY)
