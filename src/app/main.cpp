#include "app/program.hpp"

int main(int argc, char** argv) { return railstrata::run_program(argc, argv); }
