#include "plots/render/picture.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>

#include "albedo/core/errors.hpp"
#include "analysis/text/text.hpp"

namespace albedo::render {
namespace {

/// sRGB's curve [IEC 61966-2-1].
double srgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

std::uint8_t byte(double value) {
  if (!std::isfinite(value)) throw ParameterError("picture: a pixel isn't finite and must be for a PNG");
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}
[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }

/// libpng's writer, freed in the end.
class PngWriter {
 public:
  PngWriter() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  /// @param channels 1 (grey) or 3
  std::string write(const std::vector<std::uint8_t>& bytes, std::size_t width, int channels, bool is_srgb,
                    const std::string& provenance) {
    std::string result;
    png_set_write_fn(png_, &result, append, nullptr);
    const std::size_t row = width * static_cast<std::size_t>(channels);
    const std::size_t height = bytes.size() / row;
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                 channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (is_srgb) png_set_sRGB(png_, info_, PNG_sRGB_INTENT_RELATIVE);
    std::string key = "albedo", value = provenance;
    png_text text{};
    text.compression = PNG_ITXT_COMPRESSION_NONE;
    text.key = key.data();
    text.text = value.data();
    text.itxt_length = value.size();
    png_set_text(png_, info_, &text, 1);
    png_write_info(png_, info_);
    for (std::size_t y = 0; y < height; ++y) png_write_row(png_, bytes.data() + y * row);
    png_write_end(png_, nullptr);
    return result;
  }

 private:
  png_structp png_;
  png_infop info_ = nullptr;
};

/// OpenEXR's view of a stream of bytes.
class StreamAdapter : public Imf::OStream {
 public:
  explicit StreamAdapter(std::ostream& stream) : OStream("picture"), stream_(stream) {}
  void write(const char data[], int size) override { stream_.write(data, size); }
  uint64_t tellp() override { return static_cast<uint64_t>(std::streamoff(stream_.tellp())); }
  void seekp(uint64_t place) override { stream_.seekp(static_cast<std::streamoff>(place)); }

 private:
  std::ostream& stream_;
};

}  // namespace

Picture picture_of(const Rendering& rendering, Colour (*colour)(const Spectrum&)) {
  Picture picture(rendering.width, rendering.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = colour(rendering.mean[i]);
  picture.error = rendering.error;
  return picture;
}

Colour first_three(const Spectrum& spectrum) { return {spectrum[0], spectrum[1], spectrum[2]}; }

Picture mosaic(const std::vector<Picture>& pictures, std::size_t columns, std::size_t gap, double grey) {
  const std::size_t rows = (pictures.size() + columns - 1) / columns;
  const std::size_t step_x = pictures.front().width + gap, step_y = pictures.front().height + gap;
  Picture result(columns * step_x - gap, rows * step_y - gap, {grey, grey, grey});
  if (!pictures.front().error.empty()) result.error.assign(result.pixels.size(), 0);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture& part = pictures[i];
    for (std::size_t y = 0; y < part.height; ++y) {
      for (std::size_t x = 0; x < part.width; ++x) {
        const std::size_t to_x = (i % columns) * step_x + x, to_y = (i / columns) * step_y + y;
        result.at(to_x, to_y) = part.at(x, y);
        if (!result.error.empty()) result.error[to_y * result.width + to_x] = part.error[y * part.width + x];
      }
    }
  }
  return result;
}

std::string encode_png(const Picture& picture, double exposure, const nlohmann::ordered_json& provenance) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * picture.pixels.size());
  for (const Colour& colour : picture.pixels) {
    for (const double value : colour) bytes.push_back(byte(srgb(exposure * value)));
  }
  return PngWriter().write(bytes, picture.width, 3, true, analysis::json_text(provenance));
}

std::string encode_png(const std::vector<double>& values, std::size_t width, double low, double high,
                       const nlohmann::ordered_json& provenance) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(values.size());
  for (const double value : values) bytes.push_back(byte((value - low) / (high - low)));
  return PngWriter().write(bytes, width, 1, false, analysis::json_text(provenance));
}

std::string encode_exr(const Picture& picture, const nlohmann::ordered_json& provenance) {
  Imf::Header header(static_cast<int>(picture.width), static_cast<int>(picture.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.insert("albedo", Imf::StringAttribute(analysis::json_text(provenance)));
  std::vector<std::pair<const char*, std::vector<float>>> channels{{"R", {}}, {"G", {}}, {"B", {}}};
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Colour& colour : picture.pixels) channels[c].second.push_back(static_cast<float>(colour[c]));
  }
  if (!picture.error.empty()) channels.emplace_back("error.Y", std::vector<float>{});
  for (const double error : picture.error) channels.back().second.push_back(static_cast<float>(error));

  Imf::FrameBuffer frame;
  for (auto& [name, values] : channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                  sizeof(float) * picture.width));
  }
  std::ostringstream bytes;
  {
    StreamAdapter adapter(bytes);
    Imf::OutputFile image(adapter, header, 0);
    image.setFrameBuffer(frame);
    image.writePixels(static_cast<int>(picture.height));
  }
  return bytes.str();
}

double saturated_part(const Picture& picture, double exposure) {
  const auto saturated = [exposure](const Colour& colour) {
    return std::ranges::any_of(colour, [exposure](double value) { return value < 0 || exposure * value > 1; });
  };
  return static_cast<double>(std::ranges::count_if(picture.pixels, saturated)) /
         static_cast<double>(picture.pixels.size());
}

}  // namespace albedo::render
