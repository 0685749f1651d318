// Control of OpenBLAS in programs that load it: one thread, and memory reserved in advance.
#pragma once

namespace tacipc {

/// Restarts the program without OpenBLAS's worker threads, if there are any, and does not return then. OpenBLAS starts
/// a thread per core when it is loaded. No stage needs them, and if memory is short, they retry forever, so that the
/// program cannot end.
/// \param argv arguments of main(); with other arguments the call does nothing
void leave_blas_threads(char** argv);

/// Reserves the memory that OpenBLAS needs for `calls` simultaneous calls, because a call would retry forever.
/// \throw std::bad_alloc if the memory is not available
void reserve_blas_memory(int calls);

}  // namespace tacipc
