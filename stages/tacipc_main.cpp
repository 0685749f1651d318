// The program tacipc, the front door to all others.
#include "build_facts.h"
#include "common/command/front_door.h"

int main(int argc, char** argv) { return tacipc::front_door({argv + 1, argv + argc}, tacipc::build_facts()); }
