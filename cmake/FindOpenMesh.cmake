# The two libraries of OpenMesh as targets OpenMeshCore and OpenMeshTools. Debian's libopenmesh-dev would bring OpenSceneGraph for programs of its
# own, a hundred packages that nothing here needs: the goal `packages` unpacks its headers into unpacked/ of the build folder instead.
find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh HINTS ${PROJECT_BINARY_DIR}/unpacked/usr/include
          ${PROJECT_SOURCE_DIR}/build/release/unpacked/usr/include)  # presets beside release take what it unpacked
find_library(OPENMESH_CORE_LIBRARY NAMES OpenMeshCore libOpenMeshCore.so.9.0)
find_library(OPENMESH_TOOLS_LIBRARY NAMES OpenMeshTools libOpenMeshTools.so.9.0)
file(REAL_PATH "${OPENMESH_CORE_LIBRARY}" openmesh_file)
string(REGEX MATCH "[0-9][0-9.]*$" OpenMesh_VERSION "${openmesh_file}")
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenMesh REQUIRED_VARS OPENMESH_CORE_LIBRARY OPENMESH_TOOLS_LIBRARY OPENMESH_INCLUDE_DIR VERSION_VAR OpenMesh_VERSION)
if(OpenMesh_FOUND AND NOT TARGET OpenMeshCore)
  foreach(part Core Tools)
    string(TOUPPER ${part} upper)
    add_library(OpenMesh${part} UNKNOWN IMPORTED)
    set_target_properties(OpenMesh${part} PROPERTIES IMPORTED_LOCATION ${OPENMESH_${upper}_LIBRARY}
                                                     INTERFACE_INCLUDE_DIRECTORIES ${OPENMESH_INCLUDE_DIR})
  endforeach()
endif()
mark_as_advanced(OPENMESH_INCLUDE_DIR OPENMESH_CORE_LIBRARY OPENMESH_TOOLS_LIBRARY)
