// The program starts no others on Windows (study_run.cpp): nothing of child_process.hpp is called.
#include "study/child_process.hpp"
