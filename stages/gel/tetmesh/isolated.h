// Runs code that may crash in a process of its own.
#pragma once

#include <functional>
#include <string>

namespace tacipc {

/// Runs `work` in a child process with closed standard output and returns the bytes that it returns. The child ends
/// when the parent does.
/// \throw DataError `WHAT crashed (signal N)` if the child dies, `WHAT …` with the text if `work` throws a DataError
std::string run_isolated(const std::string& what, const std::function<std::string()>& work);

}  // namespace tacipc
