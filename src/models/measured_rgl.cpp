#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/text.hpp"
#include "models/measured.hpp"

namespace albedo {
namespace {

/// A named array of the file.
struct Field {
  std::string name;
  int type = 0;
  std::size_t begin = 0;
  std::vector<std::size_t> shape{};

  [[nodiscard]] std::size_t count() const {
    std::size_t product = 1;
    for (const std::size_t length : shape) product *= length;
    return product;
  }
};

/// Reads the file's head from front to back, never past its end.
class Head {
 public:
  explicit Head(const MeasuredFile& file) : file_(file) {}

  template <class Number>
  Number number() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) value |= std::uint64_t{byte()} << (8 * i);
    return static_cast<Number>(value);
  }
  std::string text(std::size_t length) {
    std::string result;
    for (std::size_t i = 0; i < length; ++i) result.push_back(static_cast<char>(byte()));
    return result;
  }

 private:
  unsigned char byte() {
    if (at_ >= file_.bytes.size()) file_.refuse("ends within its header");
    return file_.bytes[at_++];
  }

  const MeasuredFile& file_;
  std::size_t at_ = 0;
};

Field read_field(const MeasuredFile& file, Head& head) {
  constexpr std::array<std::size_t, 12> sizes{0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
  constexpr int most_dimensions = 16;
  const auto length = head.number<std::uint16_t>();
  Field field{.name = head.text(length)};
  const int dimensions = head.number<std::uint16_t>();
  field.type = head.number<std::uint8_t>();
  const auto begin = head.number<std::uint64_t>();
  if (dimensions > most_dimensions) file.refuse(fmt::format("is corrupt: a field has {} dimensions", dimensions));
  if (field.type < 1 || field.type > 11) file.refuse(fmt::format("is corrupt: a field is of type {}", field.type));
  const std::uint64_t size = file.bytes.size();
  std::uint64_t bytes = sizes[static_cast<std::size_t>(field.type)];
  for (int i = 0; i < dimensions; ++i) {
    const auto extent = head.number<std::uint64_t>();
    if (extent == 0 || extent > size) {
      file.refuse(
          fmt::format("is truncated or corrupt: a field has a dimension of {} in a file of {} bytes", extent, size));
    }
    if (extent > size / bytes) {
      file.refuse(fmt::format("is truncated: a field is larger than the file of {} bytes", size));
    }
    bytes *= extent;
    field.shape.push_back(static_cast<std::size_t>(extent));
  }
  if (begin > size || bytes > size - begin) {
    file.refuse(fmt::format("is truncated: a field of {} bytes at {} in a file of {}", bytes, begin, size));
  }
  field.begin = static_cast<std::size_t>(begin);
  return field;
}

class Fields {
 public:
  explicit Fields(const MeasuredFile& file) : file_(file) {
    Head head(file);
    head.text(tensor_magic_size);
    const int major = head.number<std::uint8_t>(), minor = head.number<std::uint8_t>();
    if (major != 1 || minor != 0) {
      file.refuse(fmt::format("has version {}.{} and must have 1.0", major, minor));
    }
    const auto count = head.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) fields_.push_back(read_field(file, head));
  }

  /// @param dimensions  0 for any number
  [[nodiscard]] const Field& field(const std::string& name, std::size_t dimensions) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.name == name; });
    if (found == fields_.end()) {
      file_.refuse("has no field '" + name + "'" +
                   (name == "rgb" ? ": only RGB files can be read, not spectral ones" : ""));
    }
    if (found->shape.size() != dimensions) {
      file_.refuse(
          fmt::format("has {} dimensions in field '{}' and must have {}", found->shape.size(), name, dimensions));
    }
    return *found;
  }

  /// Entries from the given one on of a field of float32.
  [[nodiscard]] std::vector<double> values(const Field& field, std::size_t first, std::size_t count) const {
    constexpr int float32 = 10;
    if (field.type != float32) file_.refuse("has a field '" + field.name + "' that isn't of type float32");
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      float value = 0;
      std::memcpy(&value, file_.bytes.data() + field.begin + (first + i) * sizeof value, sizeof value);
      if (!std::isfinite(value)) file_.refuse("has a number in field '" + field.name + "' that isn't finite");
      result[i] = static_cast<double>(value);
    }
    return result;
  }
  [[nodiscard]] std::vector<double> values(const Field& field) const { return values(field, 0, field.count()); }

  [[nodiscard]] unsigned char byte(const Field& field) const { return file_.bytes[field.begin]; }

 private:
  const MeasuredFile& file_;
  std::vector<Field> fields_;
};

/// Values on a grid of the unit square, row by row.
struct Grid {
  std::size_t width = 0, height = 0;
  std::vector<double> values{};

  [[nodiscard]] double operator()(std::size_t row, std::size_t column) const { return values[row * width + column]; }
  [[nodiscard]] double bilinear(double x, double y) const {
    const Between column = between(x, width), row = between(y, height);
    const auto along = [&](std::size_t r) {
      return std::lerp((*this)(r, column.index), (*this)(r, column.index + 1), column.share);
    };
    return std::lerp(along(row.index), along(row.index + 1), row.share);
  }
};

Grid grid_of(const Fields& fields, const MeasuredFile& file, const std::string& name, std::size_t dimensions,
             std::size_t slice, std::size_t plane = 0) {
  const Field& field = fields.field(name, dimensions);
  const std::size_t width = field.shape[dimensions - 1], height = field.shape[dimensions - 2];
  if (width < 2 || height < 2) file.refuse("has a field '" + name + "' of less than 2 by 2 entries");
  const std::size_t planes = dimensions == 5 ? field.shape[2] : 1;
  return {width, height, fields.values(field, (slice * planes + plane) * width * height, width * height)};
}

void require_not_negative(const MeasuredFile& file, const Grid& grid, const std::string& name) {
  if (std::any_of(grid.values.begin(), grid.values.end(), [](double v) { return v < 0; })) {
    file.refuse("has a negative number in field '" + name + "'");
  }
}

double to_unit(double theta) { return std::sqrt(2 * theta / pi<double>); }

/// What belongs to one θ_i: the density, its sums along rows from their first entry, the sums of rows from the first
/// row, all over the density's integral; and the colour.
struct Slice {
  Grid density{}, conditional{};
  std::vector<double> marginal{};
  Grid colour{};
};

Slice slice_of(const MeasuredFile& file, Grid density, Grid colour) {
  Slice slice{.density = std::move(density), .conditional = {}, .marginal = {}, .colour = std::move(colour)};
  Grid& d = slice.density;
  slice.conditional = {d.width, d.height, std::vector<double>(d.values.size(), 0.0)};
  slice.marginal.assign(d.height, 0.0);
  std::vector<double>& sums = slice.conditional.values;
  for (std::size_t row = 0; row < d.height; ++row) {
    for (std::size_t i = row * d.width + 1; i < (row + 1) * d.width; ++i) {
      sums[i] = sums[i - 1] + (d.values[i - 1] + d.values[i]) / 2;
    }
    if (row > 0) {
      const double below = slice.conditional(row - 1, d.width - 1), here = slice.conditional(row, d.width - 1);
      slice.marginal[row] = slice.marginal[row - 1] + (below + here) / 2;
    }
  }
  const double total = slice.marginal.back();
  if (!(total > 0)) file.refuse("has a slice of field 'vndf' that is 0 everywhere");
  for (auto* values : {&d.values, &sums, &slice.marginal}) {
    for (double& value : *values) value /= total;
  }
  return slice;
}

class RglTable final : public MeasuredTable {
 public:
  RglTable(std::vector<double> thetas, std::vector<Slice> slices, Grid ndf, Grid sigma)
      : thetas_(std::move(thetas)), slices_(std::move(slices)), ndf_(std::move(ndf)), sigma_(std::move(sigma)) {}

  [[nodiscard]] bool reciprocal() const noexcept override { return false; }

  [[nodiscard]] double evaluate(const DirectionPair<double>& pair) const noexcept override {
    if (!(pair.cos_theta_v > 0)) return 0;
    const HalfAngles half = half_angles(pair);
    const double theta = theta_of_light(pair);
    const double x = to_unit(half.theta), y = (half.phi + pi<double>) / (2 * pi<double>);
    const Weighted slice = weighted(theta);
    const auto [s_x, s_y] = warped(slice, x, y);
    const double colour = slice.mixed([&, a = s_x, b = s_y](const Slice& s) { return s.colour.bilinear(a, b); });
    constexpr double middle = 0.5;  // φ_i = 0
    return colour * ndf_.bilinear(x, y) / (4 * sigma_.bilinear(to_unit(theta), middle) * pair.cos_theta_v);
  }

 private:
  /// Two neighbouring slices.
  struct Weighted {
    const Slice& first;
    const Slice& second;
    double share;  // of the second

    template <class Function>
    [[nodiscard]] double mixed(const Function& of) const {
      return std::lerp(of(first), of(second), share);
    }
  };

  [[nodiscard]] Weighted weighted(double theta) const {
    const auto above = std::upper_bound(thetas_.begin() + 1, thetas_.end() - 1, theta);
    const auto k = static_cast<std::size_t>(above - thetas_.begin());
    const double share = std::clamp((theta - thetas_[k - 1]) / (thetas_[k] - thetas_[k - 1]), 0.0, 1.0);
    return {slices_[k - 1], slices_[k], share};
  }

  /// Where the sampling of the density comes from to reach (x, y).
  [[nodiscard]] static std::pair<double, double> warped(const Weighted& slice, double x, double y) {
    const Between column = between(x, slice.first.density.width), row = between(y, slice.first.density.height);
    const std::size_t last = slice.first.density.width - 1;
    const auto along = [&](const Grid Slice::*grid, std::size_t j, std::size_t i) {
      return slice.mixed([&](const Slice& s) { return (s.*grid)(j, i); });
    };
    const auto across = [&](const Grid Slice::*grid, std::size_t i) {
      return std::lerp(along(grid, row.index, i), along(grid, row.index + 1, i), row.share);
    };
    const double left = across(&Slice::density, column.index), right = across(&Slice::density, column.index + 1);
    const double within = column.share * (left + column.share * (right - left) / 2);
    const double low = along(&Slice::conditional, row.index, last),
                 high = along(&Slice::conditional, row.index + 1, last);
    const double whole = std::lerp(low, high, row.share);
    const double before = slice.mixed([&](const Slice& s) { return s.marginal[row.index]; });
    const double s_x = whole > 0 ? (across(&Slice::conditional, column.index) + within) / whole : 0;
    return {s_x, before + row.share * (low + row.share * (high - low) / 2)};
  }

  std::vector<double> thetas_;
  std::vector<Slice> slices_;
  Grid ndf_, sigma_;
};

}  // namespace

std::shared_ptr<const MeasuredTable> read_rgl(const MeasuredFile& file, int channel, bool negative_as_zero) {
  const Fields fields(file);
  if (fields.field("phi_i", 1).count() > 2) file.refuse("is anisotropic, and only isotropic materials can be read");
  if (fields.byte(fields.field("jacobian", 1)) != 1) file.refuse("has a field 'jacobian' that isn't 1");
  const std::vector<double> thetas = fields.values(fields.field("theta_i", 1));
  constexpr double slack = 1e-4;  // float32, rounded up
  const bool ascending =
      std::adjacent_find(thetas.begin(), thetas.end(), [](double a, double b) { return !(a < b); }) == thetas.end();
  if (thetas.size() < 2 || !ascending || thetas.front() < 0 || thetas.back() > pi<double> / 2 + slack) {
    file.refuse("has a field 'theta_i' that isn't two or more ascending angles within [0, pi/2]");
  }
  const Field &vndf = fields.field("vndf", 4), &rgb = fields.field("rgb", 5);
  const std::size_t azimuths = fields.field("phi_i", 1).count();
  if (vndf.shape[0] != azimuths || vndf.shape[1] != thetas.size() || rgb.shape[0] != azimuths ||
      rgb.shape[1] != thetas.size() || rgb.shape[2] != 3) {
    file.refuse("has fields 'vndf' and 'rgb' whose sizes don't match 'phi_i' and 'theta_i'");
  }
  Grid ndf = grid_of(fields, file, "ndf", 2, 0), sigma = grid_of(fields, file, "sigma", 2, 0);
  require_not_negative(file, ndf, "ndf");
  if (std::any_of(sigma.values.begin(), sigma.values.end(), [](double v) { return !(v > 0); })) {
    file.refuse("has a number in field 'sigma' that isn't positive");
  }
  std::vector<Slice> slices;
  for (std::size_t k = 0; k < thetas.size(); ++k) {
    Grid density = grid_of(fields, file, "vndf", 4, k);
    require_not_negative(file, density, "vndf");
    Grid colour = grid_of(fields, file, "rgb", 5, k, static_cast<std::size_t>(channel));
    if (negative_as_zero) {
      for (double& value : colour.values) value = std::max(value, 0.0);
    }
    slices.push_back(slice_of(file, std::move(density), std::move(colour)));
  }
  return std::make_shared<RglTable>(thetas, std::move(slices), std::move(ndf), std::move(sigma));
}

}  // namespace albedo
