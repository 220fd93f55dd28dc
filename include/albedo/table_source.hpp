/// @file
/// The entries of a table one by one, for those who keep them elsewhere than in memory, or make models of their own.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "albedo/table.hpp"

namespace albedo {

/// Makes the model of a place on the axes that are no directions, in their order: the number there or, on an axis of
/// names, the index of the name. Called from any thread, wherever a place isn't that of the entry before.
using TableModels = std::function<std::shared_ptr<const Model>(const std::vector<double>& place)>;

/// The same models, where making one is dear: those that were used last are kept, and nobody makes one that another
/// thread is making.
[[nodiscard]] TableModels kept(TableModels models, std::size_t most = 256);

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
    /// @param place one value for each axis; of a name its index
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

  /// A cell of the grid, by the indices of its first corner.
  using Cell = std::vector<std::size_t>;

  /// @throws UnknownModel, ParameterError as AlbedoTable does
  TableSource(const std::string& model, Parameters fixed, std::vector<TableAxis> axes, TableOptions options = {});

  /// A table of any models.
  /// @throws ParameterError for options or directions outside their range, axes without values or of the same name, and
  /// unless one of them is a `cos_theta` or `theta`; for `options.correction`, which is the business of `models` here
  TableSource(TableModels models, std::vector<TableAxis> axes, TableOptions options = {});

  [[nodiscard]] std::size_t size() const { return size_; }  ///< entries
  [[nodiscard]] const std::vector<TableAxis>& axes() const { return axes_; }
  [[nodiscard]] const TableOptions& options() const { return options_; }
  [[nodiscard]] int threads() const { return threads_; }  ///< of the options, or as many as OpenMP would use

  /// Compares the table with the albedo in parallel, at the centres of `verified_cells` of the options.
  /// @param value gives any entry of the filled table; called from any thread
  [[nodiscard]] Interpolation interpolation(const std::function<double(std::size_t entry)>& value) const;
  /// The same at the centres of these cells.
  [[nodiscard]] Interpolation interpolation(const std::function<double(std::size_t entry)>& value,
                                            const std::vector<Cell>& cells) const;

 private:
  TableModels models_;
  std::vector<TableAxis> axes_;
  TableOptions options_;
  std::size_t size_;
  int threads_;
  std::size_t polar_ = 0;  // the axis of the polar angle
  bool is_in_degrees_ = false;
  std::optional<std::size_t> phi_;
  std::vector<std::size_t> model_axes_;  // all others
};

}  // namespace albedo
