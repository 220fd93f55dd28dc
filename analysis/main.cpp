#include "albedo/command_line.hpp"

int main(int argc, char** argv) { return albedo::command_line(argc, argv); }
