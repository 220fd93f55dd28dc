#include "albedo/command_line.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <iostream>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>

#include "albedo/core/errors.hpp"
#include "albedo/version.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/files/ranks.hpp"
#include "analysis/text/value.hpp"

namespace albedo {
namespace {

using namespace analysis;

int run(int argc, const char* const* argv) {
  ProgramSyntax program("The directional albedo of reflectance models, with errors that can be believed.",
                        program_name(argc, argv), "albedo " + std::string(albedo::version));
  program.footer("Every subcommand has its own --help.\nExample:\n  albedo at ward alpha=0.1 --theta 0,60,89.9");
  const std::array commands{add_models(program),     add_at(program),       add_curve(program),     add_table(program),
                            add_audit(program),      add_claims(program),   add_pump(program),      add_shader(program),
                            add_divergence(program), add_tradeoff(program), add_stability(program), add_plan(program)};
  if (program.parse(argc, argv)) return exit_code::done;
  const auto chosen = std::ranges::find_if(commands, [](const Command& command) { return command.syntax.was_given(); });
  if (chosen == commands.end()) {
    std::cerr << program.help();
    return exit_code::usage;
  }
  chosen->syntax.check_understood();
  return chosen->run(quoted_command_line(argc, argv));
}

/// What was printed may wait in a buffer until now.
void flush_output() {
  errno = 0;
  if (std::cout.flush()) return;
  throw cannot_write("standard output", std::generic_category().message(errno != 0 ? errno : EIO));
}

}  // namespace

/// The one translator of exceptions to exit codes.
int command_line(int argc, const char* const* argv) {
  // The processes of one table all have the same to say; the first to end with an error is the end of all.
  const bool is_heard = launch().rank == 0 || argc < 2 || std::string_view(argv[1]) != "table";
  const auto complain = [&](const std::string& message, int code) {
    if (is_heard) {
      std::cerr << "albedo: " + message + '\n';
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    return code;
  };
  try {
    const int code = run(argc, argv);
    flush_output();
    return code;
  } catch (const albedo::WriteError& error) {
    return complain(error.what(), exit_code::write_failed);
  } catch (const albedo::Error& error) {
    return complain(error.what(), exit_code::usage);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory", exit_code::internal_error);
  } catch (const std::exception& error) {
    return complain("internal error: " + std::string(error.what()), exit_code::internal_error);
  }
}

}  // namespace albedo
