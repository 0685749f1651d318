# Warnings, floating-point rules and the compiler's memory for our own targets only; third-party headers come in as SYSTEM.
add_library(tacipc_warnings INTERFACE)
add_library(tacipc::warnings ALIAS tacipc_warnings)
target_compile_options(tacipc_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
                                                 -Wconversion -Wno-sign-conversion)
if(TACIPC_WARNINGS_AS_ERRORS)
  target_compile_options(tacipc_warnings INTERFACE -Werror)
endif()
# No contraction into fused multiply-adds behind our back: the same source gives the same bits at any optimisation level.
target_compile_options(tacipc_warnings INTERFACE -ffp-contract=off -march=${TACIPC_MARCH})
# Packs (common/base/simd.h) are passed between inlined functions only, so how they would be passed is no matter.
target_compile_options(tacipc_warnings INTERFACE -Wno-psabi)
# GCC 12 suspects its own std::string of these; in headers compiled in advance it no longer knows that they are not ours.
target_compile_options(tacipc_warnings INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
# GCC collects garbage from 128 MB on; from 400 MB on it takes a seventh less time and a seventh more memory.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(tacipc_warnings INTERFACE --param=ggc-min-heapsize=400000)
endif()
