#pragma once

namespace albedo {

/// The program `albedo`, as a function: its subcommands know the models of register_model() too.
///
/// Its target is albedo::command_line, of find_package(albedo COMPONENTS command_line). It prints to standard output
/// and standard error, and throws nothing.
/// @returns the program's exit code: 0 done, 1 a check failed, 2 wrong input, 3 a result missed its tolerance, 4 cannot
/// write
int command_line(int argc, const char* const* argv);

}  // namespace albedo
