#include "tests/fuzz/fuzzed_readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tacipc::FuzzedReader& reader = tacipc::fuzzed_reader(TACIPC_FUZZED_READER);
  tacipc::read_input(reader, {reinterpret_cast<const char*>(data), size});
  return 0;
}
