// Instruction set of the current processor, as a level that compilers use.
#pragma once

namespace tacipc {

/// Returns x86-64, x86-64-v2, x86-64-v3 or x86-64-v4.
inline const char* instruction_set() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return "x86-64-v4";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "x86-64-v3";
  return __builtin_cpu_supports("sse4.2") ? "x86-64-v2" : "x86-64";
}

}  // namespace tacipc
