/// @file
/// The subcommands of `albedo`: each takes its place on the command line, and runs once that is parsed.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

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
  CLI::App* app;
  std::function<int(const std::string& command_line)> run;  ///< returns an exit code, or throws an albedo::Error
};

Command add_models(CLI::App& program);
Command add_at(CLI::App& program);
Command add_curve(CLI::App& program);
Command add_table(CLI::App& program);
Command add_audit(CLI::App& program);
Command add_claims(CLI::App& program);
Command add_pump(CLI::App& program);
Command add_shader(CLI::App& program);
Command add_divergence(CLI::App& program);
Command add_tradeoff(CLI::App& program);
Command add_stability(CLI::App& program);
Command add_plan(CLI::App& program);

}  // namespace albedo::analysis
