// The program tacipc, which runs all other programs.
#include "build_facts.h"
#include "common/command/front_door.h"

int main(int argc, char** argv) { return tacipc::front_door({argv + 1, argv + argc}, tacipc::build_facts()); }
