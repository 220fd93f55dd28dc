#include <chrono>
#include <cstdlib>
#include <regex>
#include <set>

#include "analysis/scene_helpers.hpp"

/// Published scenes, all below the directory in the environment variable ALBEDO_SCENES_DIR: what is read of them is
/// counted again by a plain search of the text.
namespace albedo::analysis {
namespace {

using Counts = std::map<std::string, std::size_t>;

Counts bsdfs_by_search(const std::string& text) {
  Counts counts;
  const std::string tag = "<bsdf type=\"";
  for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at)) {
    at += tag.size();
    ++counts[text.substr(at, text.find('"', at) - at)];
  }
  return counts;
}

Counts materials_by_search(const std::string& text) {
  Counts counts;
  const std::regex named("\nMakeNamedMaterial[^\n]*\n *\"string type\" *\\[? *\"([a-z]*)\"|\nMaterial \"([a-z]*)\"");
  for (std::sregex_iterator match(text.begin(), text.end(), named), end; match != end; ++match) {
    ++counts[(*match)[1].str() + (*match)[2].str()];
  }
  return counts;
}

/// Lines of a modifier, a type and a name, where the type is no surface, texture or pattern.
Counts modifiers_by_search(const std::string& text) {
  static const std::set<std::string> others{"source",     "sphere",    "bubble",    "polygon",    "cone",
                                            "cup",        "ring",      "tube",      "mesh",       "cylinder",
                                            "instance",   "texfunc",   "texdata",   "brightfunc", "brightdata",
                                            "brighttext", "colorfunc", "colordata", "colorpict",  "colortext"};
  Counts counts;
  const std::regex line(
      "^(\"[^\"]*\"|[^\\s#!\"0-9]\\S*)[ \t]+([A-Za-z]\\w*)[ \t]+(\"[^\"]*\"|\\S+)([ \t]+\\S+)?[ \t]*$");
  std::istringstream lines(text);
  bool continues = false;
  for (std::string one; std::getline(lines, one);) {
    const bool is_command = continues || one.starts_with('!');
    continues = is_command && one.ends_with('\\');
    std::smatch match;
    if (is_command || !std::regex_match(one, match, line) || others.contains(match[2])) continue;
    if (match[4].matched && match[2] != "alias") continue;  // of others, a fourth word is no part of the head
    ++counts[match[2]];
  }
  return counts;
}

TEST(SceneData, NothingIsLost) {
  const char* directory = std::getenv("ALBEDO_SCENES_DIR");
  if (directory == nullptr) GTEST_SKIP() << "ALBEDO_SCENES_DIR isn't set";
  std::size_t files = 0, modelled = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    const std::string ending = entry.path().extension().string(), path = entry.path().string();
    if (ending != ".xml" && ending != ".pbrt" && ending != ".rad" && ending != ".mat") continue;
    const std::string text = read(entry.path());
    const auto begin = std::chrono::steady_clock::now();
    const Scene scene = read_scene(path);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10)) << path;
    ++files;
    modelled += scene.materials.size();

    Counts found = scene.holders;
    for (const auto& [type, count] : scene.unmodelled) found[type] += count;
    for (const SceneMaterial& material : scene.materials) ++found[material.type];
    EXPECT_EQ(found, ending == ".xml"    ? bsdfs_by_search(text)
                     : ending == ".pbrt" ? materials_by_search(text)
                                         : modifiers_by_search(text))
        << path;
    std::size_t total = 0;
    for (const auto& [type, count] : found) total += count;
    EXPECT_EQ(total, scene.declared) << path;

    for (const SceneMaterial& material : scene.materials) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NO_THROW(make_material(material.material, channel, path)) << path << " " << material.material.name;
      }
      for (const ParameterInterval& interval : material.intervals) EXPECT_LE(interval.low, interval.high);
    }
  }
  EXPECT_GT(files, 0U) << directory << " holds no scenes";
  EXPECT_GT(modelled, 0U);
}

TEST(SceneData, TwoFormatsOfAStaircaseAgree) {
  const char* directory = std::getenv("ALBEDO_SCENES_DIR");
  if (directory == nullptr) GTEST_SKIP() << "ALBEDO_SCENES_DIR isn't set";
  const fs::path scenes = fs::path(directory) / "scenes";
  const fs::path xml = scenes / "mitsuba" / "staircase__scene.xml", text = scenes / "pbrt" / "staircase__scene-v4.pbrt";
  if (!fs::exists(xml) || !fs::exists(text)) GTEST_SKIP() << "the staircase isn't there";
  const Scene mitsuba = read_scene(xml.string()), pbrt = read_scene(text.string());
  std::size_t compared = 0;
  for (const SceneMaterial& a : mitsuba.materials) {
    for (const SceneMaterial& b : pbrt.materials) {
      if (a.material.name != b.material.name) continue;
      ++compared;
      EXPECT_EQ(a.material.model, b.material.model) << a.material.name;
      EXPECT_EQ(a.uses, b.uses) << a.material.name;
      const auto* of_a = std::get_if<double>(&a.material.lambertian);
      const auto* of_b = std::get_if<double>(&b.material.lambertian);
      if (of_a != nullptr && of_b != nullptr) {
        EXPECT_NEAR(*of_a, *of_b, 1e-6) << a.material.name;
      }
    }
  }
  EXPECT_EQ(compared, 20U);
}

}  // namespace
}  // namespace albedo::analysis
