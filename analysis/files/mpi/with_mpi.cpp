// Compiled only where the build has MPI.
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <mutex>
#include <numeric>

#include "albedo/core/errors.hpp"
#include "analysis/files/ranks.hpp"

namespace albedo::analysis {
namespace {

/// Claims by fetch-and-add on two counters in the memory of rank 0, whose program takes no part in it. Any thread calls
/// this, one at a time: MPI was asked for no more.
class MpiClaims : public TileClaims {
 public:
  MpiClaims(std::size_t count, int rank) : count_(static_cast<std::int64_t>(count)) {
    std::int64_t* counters = nullptr;
    const MPI_Aint size = rank == 0 ? counter_count * sizeof(std::int64_t) : 0;
    MPI_Win_allocate(size, sizeof(std::int64_t), MPI_INFO_NULL, MPI_COMM_WORLD, static_cast<void*>(&counters),
                     &window_);
    if (rank == 0) {
      MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window_);
      std::fill_n(counters, counter_count, 0);
      MPI_Win_unlock(0, window_);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(0, window_);
  }

  ~MpiClaims() override {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }

  MpiClaims(const MpiClaims&) = delete;
  MpiClaims& operator=(const MpiClaims&) = delete;

  [[nodiscard]] std::optional<std::size_t> next() override {
    const std::int64_t tile = fetch_and_add(claimed, 1);
    return tile < count_ ? std::optional(static_cast<std::size_t>(tile)) : std::nullopt;
  }

  void stop() override { fetch_and_add(claimed, count_); }

  std::size_t add_done(std::size_t entries) override {
    return static_cast<std::size_t>(fetch_and_add(done, static_cast<std::int64_t>(entries))) + entries;
  }

 private:
  enum Counter : MPI_Aint { claimed, done, counter_count };

  std::int64_t fetch_and_add(Counter counter, std::int64_t summand) {
    const std::lock_guard lock(mutex_);
    std::int64_t before = 0;
    MPI_Fetch_and_op(&summand, &before, MPI_INT64_T, 0, counter, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return before;
  }

  std::int64_t count_;
  MPI_Win window_ = MPI_WIN_NULL;
  std::mutex mutex_;
};

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (provided >= MPI_THREAD_SERIALIZED) return;
    MPI_Finalize();
    throw ParameterError("this MPI doesn't let threads call it (MPI_THREAD_SERIALIZED)");
  }

  ~MpiRanks() override {
    // What wasn't thrown by all: the others would wait for ever.
    if (std::uncaught_exceptions() > uncaught_ && !has_failed()) MPI_Abort(MPI_COMM_WORLD, 70);
    MPI_Finalize();
  }

  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }
  [[nodiscard]] std::unique_ptr<TileClaims> claims(std::size_t tiles) override {
    return std::make_unique<MpiClaims>(tiles, rank_);
  }

  [[nodiscard]] std::vector<std::string> gather(const std::string& text) override {
    const int length = static_cast<int>(text.size());
    std::vector<int> lengths(static_cast<std::size_t>(size_)), begins(lengths.size());
    MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::exclusive_scan(lengths.begin(), lengths.end(), begins.begin(), 0);
    std::string all(static_cast<std::size_t>(begins.back() + lengths.back()), '\0');
    MPI_Allgatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), begins.data(), MPI_CHAR, MPI_COMM_WORLD);
    std::vector<std::string> texts;
    for (std::size_t r = 0; r < lengths.size(); ++r) {
      texts.push_back(all.substr(static_cast<std::size_t>(begins[r]), static_cast<std::size_t>(lengths[r])));
    }
    return texts;
  }

 private:
  int rank_ = 0, size_ = 1;
  int uncaught_ = std::uncaught_exceptions();
};

}  // namespace

std::unique_ptr<Ranks> join_mpi_ranks() { return std::make_unique<MpiRanks>(); }

}  // namespace albedo::analysis
