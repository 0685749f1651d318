# tacipc_uses(<name> <version>): the program tacipc names it; stands beside the find_package of what is linked.
function(tacipc_uses name version)
  set_property(GLOBAL APPEND PROPERTY TACIPC_LIBRARIES "${name} ${version}")
endfunction()

# tacipc_version_in(<variable> <file> <macro> …): numbers of a header's #define lines, joined by points.
function(tacipc_version_in variable file)
  set(numbers "")
  foreach(macro IN LISTS ARGN)
    file(STRINGS ${file} line REGEX "^#[ ]*define[ ]+${macro}[ ]+\"?[0-9]" LIMIT_COUNT 1)
    string(REGEX REPLACE ".*${macro}[ ]+\"?([0-9.]+).*" "\\1" number "${line}")
    list(APPEND numbers ${number})
  endforeach()
  list(JOIN numbers "." text)
  set(${variable} ${text} PARENT_SCOPE)
endfunction()

# The header build_facts.h of the program tacipc: stages with their groups, libraries, instruction set.
function(tacipc_write_build_facts folder)
  set(stages "")
  foreach(stage IN LISTS TACIPC_STAGES)
    string(REPLACE "/" "\", \"" names ${stage})
    string(APPEND stages "{\"${names}\"}, ")
  endforeach()
  get_property(used GLOBAL PROPERTY TACIPC_LIBRARIES)
  list(REMOVE_DUPLICATES used)
  list(SORT used CASE INSENSITIVE)
  list(JOIN used "\", \"" libraries)
  file(CONFIGURE OUTPUT ${folder}/build_facts.h @ONLY CONTENT [[
#pragma once
#include "common/command/front_door.h"

namespace tacipc {
inline BuildFacts build_facts() {
  return {.stages = {@stages@},
          .libraries = {"@libraries@"},
          .compiled_for = "@TACIPC_MARCH@"};
}
}  // namespace tacipc
]])
endfunction()
