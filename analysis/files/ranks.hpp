/// @file
/// The processes that compute one table together: one, or those that mpirun or srun has started.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/files/tile_claims.hpp"

namespace albedo::analysis {

/// What a launcher says of this process in its environment: mpirun of Open MPI or MPICH, Slurm's srun.
struct Launch {
  int rank = 0, size = 1;
  std::string variable{};  ///< that says so; empty if none does
};

[[nodiscard]] Launch launch();

/// The processes that compute one table together. All of them call the same functions in the same order, from the
/// thread that has joined.
class Ranks {
 public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] virtual int rank() const = 0;  ///< from 0 on
  [[nodiscard]] virtual int size() const = 0;
  [[nodiscard]] bool is_first() const { return rank() == 0; }

  /// Claims of tiles among all threads of all ranks; gone before the ranks are.
  [[nodiscard]] virtual std::unique_ptr<TileClaims> claims(std::size_t tiles) = 0;

  /// The texts of all ranks, in their order. Returns when all have come.
  [[nodiscard]] virtual std::vector<std::string> gather(const std::string& text) = 0;

  /// Does some work, each rank its own. If any rank's throws, all throw the same: what the lowest of them has thrown.
  void together(const std::function<void()>& work);

 protected:
  /// Whether together() has thrown, for all.
  [[nodiscard]] bool has_failed() const { return has_failed_; }

 private:
  bool has_failed_ = false;
};

/// Joins the processes that were started together.
/// @throws ParameterError if there are several, and this program was built without MPI or MPI doesn't find the others
[[nodiscard]] std::unique_ptr<Ranks> join_ranks();

/// By MPI; nothing where the program was built without it. Once in a process, which then can't join again.
[[nodiscard]] std::unique_ptr<Ranks> join_mpi_ranks();

}  // namespace albedo::analysis
