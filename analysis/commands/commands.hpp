/// @file
/// The subcommands of `albedo`: each takes its place on the command line, and runs once that is parsed.
#pragma once

#include <functional>
#include <string>

#include "analysis/commands/syntax.hpp"

namespace albedo::analysis {

/// What the program answers its caller. Another number than these is a crash.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int check_failed = 1;
inline constexpr int usage = 2;          ///< also a parameter out of range, or unreadable input
inline constexpr int not_converged = 3;  ///< everything is printed, but some result missed its tolerance
inline constexpr int write_failed = 4;
inline constexpr int internal_error = 70;
}  // namespace exit_code

struct Command {
  Syntax syntax;
  std::function<int(const std::string& command_line)> run;  ///< returns an exit code, or throws an albedo::Error
};

Command add_models(ProgramSyntax& program);
Command add_at(ProgramSyntax& program);
Command add_curve(ProgramSyntax& program);
Command add_table(ProgramSyntax& program);
Command add_audit(ProgramSyntax& program);
Command add_claims(ProgramSyntax& program);
Command add_pump(ProgramSyntax& program);
Command add_shader(ProgramSyntax& program);
Command add_divergence(ProgramSyntax& program);
Command add_tradeoff(ProgramSyntax& program);
Command add_stability(ProgramSyntax& program);
Command add_plan(ProgramSyntax& program);

}  // namespace albedo::analysis
