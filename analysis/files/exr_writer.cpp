#include "analysis/files/exr_writer.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/json_writer.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

/// Which entry of a table is which pixel: channel * channel_stride + y * row_stride + x * column_stride.
struct Layout {
  std::vector<std::string> channels;
  std::size_t height = 1;
  std::size_t width = 1;
  std::size_t channel_stride = 0;
  std::size_t row_stride = 0;
  std::size_t column_stride = 1;
};

bool is_rgb(const TableAxis& axis) {
  return axis.size() == 3 && std::set(axis.labels.begin(), axis.labels.end()) == std::set<std::string>{"R", "G", "B"};
}

/// "alpha=0.1.Y": the shortest digits that tell the layers apart.
std::string layer_channel(const TableAxis& axis, std::size_t index) {
  return fmt::format("{}={}.Y", axis.name,
                     axis.is_categorical() ? axis.labels[index] : shortest_text(axis.values[index]));
}

std::vector<std::string> layer_channels(const TableAxis& axis) {
  constexpr std::size_t longest_name = 255;  // OpenEXR cuts off the rest
  std::set<std::string> names;
  std::vector<std::string> channels;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const std::string& name = channels.emplace_back(layer_channel(axis, i));
    if (name.size() > longest_name) {
      throw ParameterError("output: the channel name '" + name + "' is longer than the 255 bytes of .exr");
    }
    if (!names.insert(name).second) throw ParameterError("output: .exr has no room for two channels '" + name + "'");
  }
  return channels;
}

Layout layout_of(const std::vector<TableAxis>& axes) {
  const std::size_t rank = axes.size();
  if (rank < 1 || rank > 3) {
    throw ParameterError(fmt::format("output: .exr holds 1 to 3 axes, not {}; .npy holds any number", rank));
  }
  const auto size = [&](std::size_t i) { return axes[i].size(); };
  Layout layout{.channels = {"Y"}, .width = size(rank - 1)};
  if (rank == 2) {
    layout.height = size(0);
    layout.row_stride = layout.width;
  } else if (rank == 3 && is_rgb(axes[2])) {
    layout = {axes[2].labels, size(0), size(1), 1, 3 * size(1), 3};
  } else if (rank == 3) {
    const auto channels = is_rgb(axes[0]) ? axes[0].labels : layer_channels(axes[0]);
    layout = {channels, size(1), size(2), size(1) * size(2), size(2), 1};
  }

  constexpr std::size_t largest = std::numeric_limits<int>::max() / 2;  // OpenEXR's own limit
  for (const TableAxis& axis : axes) {
    if (axis.size() >= 1 && axis.size() < largest) continue;
    throw ParameterError(fmt::format("output: .exr holds 1 to {} entries along an axis, not {} along '{}'", largest - 1,
                                     axis.size(), axis.name));
  }
  return layout;
}

/// OpenEXR's view of an output stream.
class StreamAdapter : public Imf::OStream {
 public:
  StreamAdapter(std::ostream& stream, const std::string& path) : OStream(path.c_str()), stream_(stream) {}
  void write(const char data[], int size) override { stream_.write(data, size); }
  uint64_t tellp() override { return static_cast<uint64_t>(std::streamoff(stream_.tellp())); }
  void seekp(uint64_t place) override { stream_.seekp(static_cast<std::streamoff>(place)); }

 private:
  std::ostream& stream_;
};

float to_float(const TableDocument& table, std::size_t entry, const std::string& path) {
  const double value = table.values[entry];
  if (std::isfinite(value) && std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
    std::string number;
    append_number(number, value);
    throw cannot_write(path, "the entry " + number + " at " + describe_entry(table, entry) +
                                 " is beyond the range of the format's 32-bit float");
  }
  return static_cast<float>(value);
}

Imf::Header header_of(const TableDocument& table, const Layout& layout) {
  Imf::Header header(static_cast<int>(layout.width), static_cast<int>(layout.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : layout.channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  std::ostringstream description;
  write_json_description(table, description);
  header.insert("albedo", Imf::StringAttribute(description.str()));
  return header;
}

void write_image(const TableDocument& table, const std::string& path, std::ostream& out) {
  const Layout layout = layout_of(table.axes);
  StreamAdapter adapter(out, path);
  Imf::OutputFile image(adapter, header_of(table, layout), 0);

  // One row at a time: a stride of 0 in y lets every row of the image be read from the same place.
  std::vector<std::vector<float>> row(layout.channels.size(), std::vector<float>(layout.width));
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < row.size(); ++c) {
    frame.insert(layout.channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(row[c].data()), sizeof(float), 0));
  }
  image.setFrameBuffer(frame);
  for (std::size_t y = 0; y < layout.height; ++y) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::size_t first = c * layout.channel_stride + y * layout.row_stride;
      for (std::size_t x = 0; x < layout.width; ++x) {
        row[c][x] = to_float(table, first + x * layout.column_stride, path);
      }
    }
    image.writePixels(1);
  }
}

}  // namespace

void write_exr(const TableDocument& table, const std::string& path) {
  AtomicFile file(path);
  try {
    write_image(table, path, file.stream());
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw cannot_write(path, error.what());
  }
  file.commit();
}

void check_exr_axes(const std::vector<TableAxis>& axes) { static_cast<void>(layout_of(axes)); }

}  // namespace albedo::analysis
