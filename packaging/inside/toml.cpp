// toml++ inside the shared libraries: its headers hold all of it.
#undef TOML_SHARED_LIB
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
