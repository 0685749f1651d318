// OpenBLAS, in programs that have loaded it: one thread of it, and memory that it does not wait for.
#pragma once

namespace tacipc {

/// OpenBLAS starts a thread per core as it is loaded. No stage wants them, and where memory is short they try for ever
/// to get some, so that the program cannot end. If there are any, this starts the program anew without them and does
/// not return. `argv`: of main; other arguments change nothing.
void leave_blas_threads(char** argv);

/// Takes the memory that OpenBLAS needs for as many calls at a time, since a call would try for ever to get it.
/// \throw std::bad_alloc if it is not to be had
void reserve_blas_memory(int calls);

}  // namespace tacipc
