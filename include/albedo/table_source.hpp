/// @file
/// The entries of a table one by one, for those who keep them elsewhere than in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "albedo/table.hpp"

namespace albedo {

/// What is known of some entries of a table without the entries themselves. Tallies of disjoint parts may be merged in
/// any order: the result is the same.
struct TableTally {
  double worst_error = -1;  ///< largest absolute error of a finite entry; negative if there is none
  std::size_t worst_entry = 0, unconverged = 0, divergent = 0;
  std::int64_t evaluations = 0;  ///< of the BRDF

  void add(std::size_t entry, const Estimate& estimate);
  void merge(const TableTally& other);
};

/// Computes any entries of the table that an AlbedoTable of the same arguments would hold, with the same bits.
class TableSource {
 public:
  /// What one thread computes with; it keeps the model of the last entry. The source must outlive it.
  class Worker {
   public:
    explicit Worker(const TableSource& source) : source_(&source), place_(source.axes_.size()) {}

    /// Computes the entries from number `first` on (C order: the last axis is the fastest).
    /// @param errors as many as values, or none
    TableTally fill(std::size_t first, std::span<double> values, std::span<double> errors = {});

    /// The albedo on the grid or between.
    /// @param place one value for each axis
    [[nodiscard]] Estimate at(const std::vector<double>& place);

   private:
    const TableSource* source_;
    std::shared_ptr<const Model> model_;
    std::vector<double> place_, model_place_;
  };

  /// How far linear interpolation is from the albedo.
  struct Interpolation {
    double error = 0;  ///< the largest met, absolute
    std::int64_t evaluations = 0;
  };

  /// @throws UnknownModel, ParameterError as AlbedoTable does
  TableSource(std::string model, Parameters fixed, std::vector<TableAxis> axes, TableOptions options = {});
  ~TableSource();
  TableSource(const TableSource&) = delete;
  TableSource& operator=(const TableSource&) = delete;

  [[nodiscard]] std::size_t size() const { return size_; }  ///< entries
  [[nodiscard]] const std::vector<TableAxis>& axes() const { return axes_; }
  [[nodiscard]] int threads() const { return threads_; }  ///< of the options, or as many as OpenMP would use

  /// Verifies `verified_cells` of the options, in parallel.
  /// @param value gives any entry of the filled table; called from any thread
  [[nodiscard]] Interpolation interpolation(const std::function<double(std::size_t entry)>& value) const;

 private:
  class CorrectedModels;

  [[nodiscard]] std::shared_ptr<const Model> model_at(const std::vector<double>& place) const;

  std::string model_;
  Parameters fixed_;
  std::vector<TableAxis> axes_;
  TableOptions options_;
  std::size_t size_;
  int threads_;
  std::unique_ptr<CorrectedModels> corrected_;
};

}  // namespace albedo
