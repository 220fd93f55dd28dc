#include "analysis/files/ranks.hpp"

#include <array>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

class SingleRank : public Ranks {
 public:
  [[nodiscard]] int rank() const override { return 0; }
  [[nodiscard]] int size() const override { return 1; }
  [[nodiscard]] std::unique_ptr<TileClaims> claims(std::size_t tiles) override {
    return std::make_unique<LocalClaims>(tiles);
  }
  [[nodiscard]] std::vector<std::string> gather(const std::string& text) override { return {text}; }
};

std::optional<int> number_in(const char* variable) {
  const char* const value = std::getenv(variable);
  if (value == nullptr) return std::nullopt;
  const std::string_view text = value;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

Launch launch() {
  struct Names {
    const char *rank, *size;
  };
  // SLURM_NTASKS would be that of a batch script, too, which is one process.
  constexpr std::array launchers{Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, Names{"PMI_RANK", "PMI_SIZE"},
                                 Names{"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};
  for (const Names& names : launchers) {
    const auto rank = number_in(names.rank), size = number_in(names.size);
    if (rank && size && *rank < *size) return {.rank = *rank, .size = *size, .variable = names.size};
  }
  return {};
}

void Ranks::together(const std::function<void()>& work) {
  if (size() == 1) return work();
  std::string failure;  // a letter for its kind, and its message
  try {
    work();
  } catch (const WriteError& error) {
    failure = std::string("w") + error.what();
  } catch (const Error& error) {
    failure = std::string("p") + error.what();
  } catch (const std::bad_alloc&) {
    failure = "m";
  } catch (const std::exception& error) {
    failure = std::string("i") + error.what();
  }
  const std::vector<std::string> failures = gather(failure);
  for (std::size_t r = 0; r < failures.size(); ++r) {
    if (failures[r].empty()) continue;
    has_failed_ = true;
    const std::string message = (r == 0 ? "" : "rank " + std::to_string(r) + ": ") + failures[r].substr(1);
    switch (failures[r].front()) {
      case 'w':
        throw WriteError(message);
      case 'p':
        throw ParameterError(message);
      case 'm':
        throw std::bad_alloc();
      default:
        throw std::runtime_error(message);
    }
  }
}

std::unique_ptr<Ranks> join_ranks() {
  const Launch started = launch();
  if (started.size == 1) return std::make_unique<SingleRank>();
  std::unique_ptr<Ranks> ranks = join_mpi_ranks();
  if (ranks != nullptr && ranks->size() == started.size) return ranks;
  const std::string begin =
      fmt::format("{} processes were started together ({}), and ", started.size, started.variable);
  if (ranks == nullptr) {
    throw ParameterError(begin + "this program was built without MPI: build it with -DALBEDO_MPI=ON, or start one");
  }
  const int found = ranks->size();
  ranks.reset();
  throw ParameterError(begin + fmt::format("MPI finds {}: this program's MPI is not the launcher's (with srun, try "
                                           "--mpi=pmix)",
                                           found));
}

}  // namespace albedo::analysis
