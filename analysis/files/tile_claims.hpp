/// @file
/// Who computes which tile of a table.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

namespace albedo::analysis {

/// Hands out every tile of a table exactly once, to whoever asks next, and counts what is done. Any thread may call it.
class TileClaims {
 public:
  TileClaims() = default;
  virtual ~TileClaims() = default;
  TileClaims(const TileClaims&) = delete;
  TileClaims& operator=(const TileClaims&) = delete;

  /// The next tile, or none if all are taken.
  [[nodiscard]] virtual std::optional<std::size_t> next() = 0;

  /// From now on nobody gets a tile.
  virtual void stop() = 0;

  /// Adds to the entries that are done, and returns how many are.
  virtual std::size_t add_done(std::size_t entries) = 0;
};

/// Claims among the threads of one process.
class LocalClaims : public TileClaims {
 public:
  explicit LocalClaims(std::size_t count) : count_(count) {}

  [[nodiscard]] std::optional<std::size_t> next() override {
    const std::size_t tile = next_.fetch_add(1, std::memory_order_relaxed);
    return tile < count_ ? std::optional(tile) : std::nullopt;
  }

  void stop() override { next_ = count_; }

  std::size_t add_done(std::size_t entries) override { return done_ += entries; }

 private:
  std::size_t count_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
};

}  // namespace albedo::analysis
