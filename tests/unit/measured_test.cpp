#include "albedo/models/measured.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <new>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/reference.hpp"
#include "measured_files.hpp"

/// Readers of measured materials, on files whose content has a closed form; and on broken ones.
namespace albedo {
namespace {

using test::merl_bytes;
using test::rgl_bytes;
using test::RglContent;
using test::TemporaryFile;

std::unique_ptr<Model> model_of(const TemporaryFile& file, const char* channel = "R") {
  return make_model("measured", {{"file", file.path()}, {"channel", channel}});
}

double unit(double theta) { return std::sqrt(2 * theta / std::numbers::pi); }

/// f cosθ_V at half vectors of given angles from L's azimuth.
template <class Check>
void for_half_vectors(const Model& model, double theta, const Check& check) {
  for (const double theta_h : {0.05, 0.3, 0.6}) {
    for (const double phi : {-2.9, -1.0, 0.2, 0.7, 2.0}) {
      for (const double turn : {0.0, 200.0}) {  // the material is isotropic
        const Direction l = Direction::from_degrees(theta, turn);
        const auto lv = unit_vector<double>(l);
        const double azimuth = phi + turn * std::numbers::pi / 180;
        const UnitVector<double> h{std::sin(theta_h) * std::cos(azimuth), std::sin(theta_h) * std::sin(azimuth),
                                   std::cos(theta_h)};
        const double cos_d = lv.x * h.x + lv.y * h.y + lv.z * h.z;
        const UnitVector<double> v{2 * cos_d * h.x - lv.x, 2 * cos_d * h.y - lv.y, 2 * cos_d * h.z - lv.z};
        if (v.z < 0.01) continue;
        const auto pair = direction_pair(lv, v, UnitVector<double>{-lv.x, -lv.y, lv.z});
        check(unit(theta_h), (phi + std::numbers::pi) / (2 * std::numbers::pi), model.evaluate(0, pair) * v.z);
      }
    }
  }
}

TEST(MeasuredRgl, FollowsTheInverseOfTheSamplingsWarp) {
  RglContent content;
  content.ndf = [](double x, double y) { return 1 + 2 * x + y; };
  content.sigma = [](double x, double) { return 0.5 + x; };
  content.vndf = [](double x, double y) { return 3 * (1 + x) * (1 + 2 * y); };  // bilinear, as tables are
  content.rgb = [](std::size_t slice, int channel, double x, double y) {
    return (channel + 1) * (1 + x + 3 * y) * (slice == 0 ? 1 : 2);
  };
  const TemporaryFile file("warp.bsdf", rgl_bytes(content));
  for (const double theta : {20.0, 45.0, 70.0}) {
    const double share = theta / 90, light = unit(theta * std::numbers::pi / 180);
    const double sigma = 0.5 + light;
    int channel = 0;
    for (const char* name : {"R", "G", "B"}) {
      ++channel;
      int checked = 0;
      for_half_vectors(*model_of(file, name), theta, [&](double x, double y, double value) {
        const double s_x = (x + x * x / 2) / 1.5, s_y = (y + y * y) / 2;
        const double colour = channel * (1 + s_x + 3 * s_y) * (1 + share);
        EXPECT_NEAR(value, colour * (1 + 2 * x + y) / (4 * sigma), 1e-6 * value) << theta << ' ' << x << ' ' << y;
        ++checked;
      });
      EXPECT_GT(checked, 10);
    }
  }
}

TEST(MeasuredRgl, AlbedoOfAConstantIsTheHemisphere) {
  RglContent content;
  content.sigma = [](double, double) { return std::numbers::pi / 2; };
  content.rgb = [](std::size_t, int channel, double, double) { return channel == 2 ? 1.5 : 0.25; };  // B is above 1
  const TemporaryFile file("constant.bsdf", rgl_bytes(content));
  const double sigma = static_cast<double>(static_cast<float>(std::numbers::pi / 2)),
               unit_albedo = std::numbers::pi / 2 / sigma;
  for (const double theta : {0.0, 30.0, 60.0, 85.0, 89.9}) {
    const Direction l = Direction::from_degrees(theta, 70);
    for (const auto& [channel, value] : {std::pair{"R", 0.25}, std::pair{"B", 1.5}}) {
      const auto model = model_of(file, channel);
      for (const Rule rule : {Rule::gauss, Rule::cubature, Rule::kronrod, Rule::tanh_sinh, Rule::stratified,
                              Rule::sobol, Rule::monte_carlo}) {
        const bool random = is_monte_carlo(rule);
        const Estimate e = directional_albedo(*model, l, {.rule = rule, .tolerance = random ? 1e-2 : 1e-6});
        EXPECT_EQ(e.status, Status::converged) << theta << ", rule " << static_cast<int>(rule);
        EXPECT_NEAR(e.value, value * unit_albedo, (random ? 4 : 1) * e.error + 1e-12)
            << theta << ", rule " << static_cast<int>(rule);
      }
      const Estimate over_all = directional_albedo(*model, l, {.warp = Warp::hemisphere, .tolerance = 1e-6});
      EXPECT_NEAR(over_all.value, value * unit_albedo, over_all.error);
      EXPECT_NE(over_all.status, Status::converged);  // where a table is large isn't known there
      EXPECT_THROW(directional_albedo(*model, l, {.warp = Warp::paper}), ParameterError);
    }
  }
  const EstimateIn<Quad> reference =
      reference_albedo(*model_of(file), Direction::from_degrees(40), {.tolerance = 1e-10});
  EXPECT_EQ(reference.status, Status::converged);
  EXPECT_NEAR(static_cast<double>(reference.value), 0.25 * unit_albedo, 1e-10);
}

TEST(MeasuredRgl, NegativeEntriesAreKeptUnlessAskedOtherwise) {
  RglContent content;
  content.rgb = [](std::size_t, int, double, double) { return -1.0; };
  const TemporaryFile file("negative.bsdf", rgl_bytes(content));
  const Direction l = Direction::from_degrees(30);
  EXPECT_LT(brdf<double>(*model_of(file), l, l), -0.2);
  EXPECT_EQ(brdf<double>(*make_model("measured", {{"file", file.path()}, {"negative", "zero"}}), l, l), 0);
}

TEST(MeasuredMerl, EntriesAreAtTheCentresOfTheirCells) {
  constexpr std::array<std::int32_t, 3> counts{6, 5, 8};
  const auto entry = [](int channel, int h, int d, int p) {
    return (channel + 1) * (10.0 + h + 2 * d) + (p < 4 ? p : 8 - p);
  };
  const TemporaryFile file("cells.binary", merl_bytes(counts, entry));
  const std::array<double, 3> scales{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  int channel = 0;
  for (const char* name : {"R", "G", "B"}) {
    const auto model = model_of(file, name);
    EXPECT_TRUE(model->claims().reciprocal);
    for (int h = 1; h < 4; ++h) {
      for (int d = 0; d < 2; ++d) {
        for (int p = 0; p < 8; ++p) {
          const double theta_h = std::pow((h + 0.5) / 6, 2) * std::numbers::pi / 2;
          const double theta_d = (d + 0.5) / 5 * std::numbers::pi / 2, phi_d = (p + 0.5) / 8 * std::numbers::pi;
          // L and V about the normal, then both turned with H
          const auto turned = [&](double phi) -> UnitVector<double> {
            const double x = std::sin(theta_d) * std::cos(phi), y = std::sin(theta_d) * std::sin(phi),
                         z = std::cos(theta_d);
            const double x1 = x * std::cos(theta_h) + z * std::sin(theta_h),
                         z1 = z * std::cos(theta_h) - x * std::sin(theta_h);
            return {x1 * std::cos(1.1) - y * std::sin(1.1), x1 * std::sin(1.1) + y * std::cos(1.1), z1};
          };
          const auto l = turned(phi_d), v = turned(phi_d + std::numbers::pi);
          if (l.z < 0.01 || v.z < 0.01) continue;
          const double expected = entry(channel, h, d, p) * scales[static_cast<std::size_t>(channel)];
          const auto f = [&](const UnitVector<double>& a, const UnitVector<double>& b) {
            return model->evaluate(0, direction_pair(a, b, UnitVector<double>{-a.x, -a.y, a.z}));
          };
          EXPECT_NEAR(f(l, v), expected, 1e-12) << h << ' ' << d << ' ' << p;
          EXPECT_NEAR(f(v, l), expected, 1e-12) << h << ' ' << d << ' ' << p;
        }
      }
    }
    ++channel;
  }
}

TEST(MeasuredMerl, AlbedoOfAConstantIsPiTimesIt) {
  const TemporaryFile file("constant.binary",
                           merl_bytes({4, 3, 5}, [](int, int h, int, int) { return h < 4 ? 150.0 : -1.0; }));
  for (const double theta : {0.0, 50.0, 85.0}) {
    const Estimate e = directional_albedo(*model_of(file), Direction::from_degrees(theta));
    EXPECT_EQ(e.status, Status::converged);
    EXPECT_NEAR(e.value, std::numbers::pi * 0.1, e.error);
  }
}

/// What is wrong with a file is said; nothing else happens.
std::string refusal(const std::string& bytes) {
  const TemporaryFile file("broken", bytes);
  try {
    model_of(file);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "none";
}

TEST(MeasuredBroken, SaysWhatIsWrong) {
  const auto with = [](const auto& change) {
    RglContent content;
    change(content);
    return refusal(rgl_bytes(content));
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_EQ(with([](RglContent&) {}), "none");
  EXPECT_TRUE(has(with([](RglContent& c) { c.azimuths = 3; }), "is anisotropic"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.rgb_name = "spectra"; }), "no field 'rgb'"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.jacobian = 0; }), "'jacobian'"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.thetas = {0.5, 0.2}; }), "ascending"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.thetas = {0, 3}; }), "ascending"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.sigma = [](double x, double) { return x; }; }), "'sigma'"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.ndf = [](double, double) { return -1; }; }), "negative"));
  EXPECT_TRUE(has(with([](RglContent& c) { c.vndf = [](double, double) { return 0; }; }), "0 everywhere"));
  EXPECT_TRUE(has(with([](RglContent& c) {
                    c.rgb = [](std::size_t, int, double, double) { return std::numeric_limits<double>::quiet_NaN(); };
                  }),
                  "isn't finite"));
  EXPECT_TRUE(has(refusal(""), "is empty"));
  EXPECT_TRUE(has(refusal("albedo"), "too short"));
  EXPECT_TRUE(has(refusal(std::string(1000, 'x')), "neither"));
  std::string merl = merl_bytes({4, 3, 5}, [](int, int, int, int) { return 1.0; });
  EXPECT_EQ(refusal(merl), "none");
  EXPECT_TRUE(has(refusal(merl + "x"), "must have"));
  EXPECT_NE(refusal(merl.substr(0, merl.size() - 1)), "none");
  merl[3] = '\x7f';
  EXPECT_TRUE(has(refusal(merl), "dimension"));
  EXPECT_THROW(make_model("measured", {{"file", "no such file.bsdf"}}), FormatError);
  EXPECT_THROW(make_model("measured", {{"file", "."}}), FormatError);
  EXPECT_THROW(make_model("measured", {{"file", 3.0}}), ParameterError);
  EXPECT_THROW(make_model("measured"), ParameterError);
  EXPECT_THROW(make_model("measured", {{"file", "x"}, {"channel", "alpha"}}), ParameterError);
}

TEST(MeasuredBroken, EveryPrefixIsRefused) {
  const std::string whole = rgl_bytes({});
  for (std::size_t size = 0; size < whole.size(); size += size < 500 ? 1 : 997) {
    EXPECT_NE(refusal(whole.substr(0, size)), "none") << size;
  }
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 1)), "none");
}

/// A material of RGL's, cut off at every twentieth of its length and within its header.
TEST(MeasuredBroken, NoPieceOfARealFileIsTakenForTheWhole) {
  const char* directory = std::getenv("ALBEDO_MEASURED_DIR");
  if (directory == nullptr) GTEST_SKIP() << "ALBEDO_MEASURED_DIR names no directory";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".bsdf") continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    ASSERT_EQ(refusal(whole), "none") << entry.path();
    std::vector<std::size_t> sizes{1, 11, 12, 13, 17, 18, 19, 40, whole.size() - 1};
    for (std::size_t i = 0; i < 20; ++i) sizes.push_back(whole.size() * i / 20);
    for (const std::size_t size : sizes) {
      const std::string message = refusal(whole.substr(0, size));
      EXPECT_NE(message, "none") << entry.path() << " cut to " << size;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    ++files;
  }
  EXPECT_GT(files, 0);
}

/// Lengths of gigabytes in a file of a kilobyte are refused without memory for them: the process may have 64 MiB more
/// than it has.
TEST(MeasuredBroken, LengthsAreCheckedBeforeAnythingIsAllocated) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer needs more address space than there is";
#endif
  const std::string head = rgl_bytes({}).substr(0, 1000);
  const auto replaced = [&](std::size_t at, std::uint64_t value, std::size_t bytes) {
    std::string changed = head;
    for (std::size_t i = 0; i < bytes; ++i) changed[at + i] = static_cast<char>(value >> (8 * i));
    return changed;
  };
  const std::size_t field = 18, type = field + 2 + 7 + 2, begin = type + 1, shape = begin + 8;
  std::vector<std::string> files{replaced(14, 0xffffffff, 4), replaced(field, 0xffff, 2), replaced(field + 9, 16, 2),
                                 replaced(field + 9, 0xffff, 2), replaced(type, 11, 1)};
  for (const std::uint64_t length : {std::uint64_t{3} << 30, std::uint64_t{1} << 61, ~std::uint64_t{0}}) {
    files.push_back(replaced(shape, length, 8));
    files.push_back(replaced(begin, length, 8));
  }
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  for (const std::array<std::int32_t, 3> counts :
       {std::array<std::int32_t, 3>{most, most, most}, {90, 90, 180}, {1 << 16, 1 << 16, 1 << 16}, {2, 2, 1 << 30}}) {
    std::string merl(1000, '\0');
    std::memcpy(merl.data(), counts.data(), sizeof counts);
    files.push_back(merl);
  }

  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages = 0;
  ASSERT_TRUE(statm >> pages);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + (64U << 20U);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  EXPECT_THROW(std::vector<char>(std::size_t{1} << 30U), std::bad_alloc);  // the limit is one
  std::vector<std::string> messages;
  for (const std::string& bytes : files) messages.push_back(refusal(bytes));
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_NE(messages[i], "none") << i;
    EXPECT_EQ(messages[i].find('\n'), std::string::npos) << messages[i];
  }
}

/// Whatever is in a header, a file is read or refused: sizes are checked before they are believed.
TEST(MeasuredBroken, NoByteOfTheHeaderCanDoHarm) {
  const std::string whole = rgl_bytes({});
  int refused = 0;
  for (std::size_t at = 0; at < 400; ++at) {
    for (const char byte : {'\0', '\x01', '\x7f', '\x80', '\xff'}) {
      std::string changed = whole;
      if (changed[at] == byte) continue;
      changed[at] = byte;
      refused += refusal(changed) == "none" ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace albedo
