# Run at build time: writes the version from git into a source file, touching it only when it changes.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --tags --always --dirty --match "v[0-9]*"
                OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(described "")
endif()
if(described MATCHES "^v")
  string(SUBSTRING "${described}" 1 -1 version)
elseif(described)
  set(version "${PROJECT_VERSION}-g${described}")
else()
  set(version "${PROJECT_VERSION}")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "common/stage/stage.h"
std::string tacipc::program_version() { return "@version@"; }
]] @ONLY)
