#include <chrono>
#include <random>

#include "analysis/scene_helpers.hpp"

namespace albedo::analysis {
namespace {

class HostileScene : public SceneTest {
 protected:
  static std::string repeated(const std::string& text, std::size_t times) {
    std::string result;
    result.reserve(text.size() * times);
    for (std::size_t i = 0; i < times; ++i) result += text;
    return result;
  }
  static std::string mitsuba(const std::string& inside) { return "<scene version=\"0.6.0\">" + inside + "</scene>"; }
  static std::string include(const std::string& name) { return mitsuba("<include filename=\"" + name + "\"/>"); }
};

TEST_F(HostileScene, LargeFilesAreNotRead) {
  for (const char* name : {"a.xml", "a.pbrt", "a.rad", "a.json"}) {
    write(name, "<");
    fs::resize_file(path(name), std::uintmax_t{1} << 40U);  // a hole, not a terabyte
    EXPECT_EQ(refusal_of(name), std::string("cannot read '") + name + "': it is larger than 64 MiB");
  }
  EXPECT_EQ(refusal_of("b.xml", repeated("<", 9'000'000)),
            "'b.xml', line 1: the scene has more than 8 million tags and attributes");
  EXPECT_TRUE(refusal_of("b.xml", repeated("<", 1000)).starts_with("'b.xml', line 1: this is not XML ("));
}

TEST_F(HostileScene, IncludesStayWithinTheDirectoryAndDontGoRound) {
  write("inner/leaf.xml", mitsuba("<bsdf type=\"diffuse\"/>"));
  write("inner/sibling.xml", include("leaf.xml"));
  EXPECT_EQ(scene_of("good.xml", include("inner/../inner/sibling.xml")).materials.size(), 1U);
  const std::string outside = "is outside of the scene's directory, ";
  for (const char* name : {"../../../../../../etc/passwd", "/etc/passwd", "inner/../../x", "../nothing-there"}) {
    EXPECT_TRUE(contains(refusal_of("a.xml", include(name)), outside)) << name;
    EXPECT_TRUE(contains(refusal_of("a.pbrt", "Include \"" + std::string(name) + "\""), outside)) << name;
  }
  fs::create_symlink("/etc/passwd", path("link.xml"));
  EXPECT_TRUE(contains(refusal_of("a.xml", include("link.xml")), outside));
  write("inner/up.xml", include("../leaf.xml"));
  EXPECT_TRUE(contains(read_scene(path("inner/leaf.xml")).path, "leaf"));
  EXPECT_TRUE(contains(refusal_of("inner/up.xml"), outside)) << "the directory is that of the file that is read";

  EXPECT_EQ(refusal_of("self.xml", include("self.xml")), "'self.xml', line 1: the include 'self.xml' includes itself");
  write("round.pbrt", "\nInclude \"inner/back.pbrt\"");
  write("inner/back.pbrt", "\n\nInclude \"./../round.pbrt\"");
  EXPECT_EQ(refusal_of("round.pbrt"), "'inner/back.pbrt', line 3: the include './../round.pbrt' includes itself");
  EXPECT_EQ(refusal_of("a.xml", include("none.xml")), "'a.xml', line 1: the include 'none.xml' doesn't exist");
  EXPECT_EQ(refusal_of("a.xml", include("inner")), "cannot read 'inner': it is not a regular file");
  for (int i = 0; i < 40; ++i) {
    write("chain" + std::to_string(i) + ".pbrt", "Include \"chain" + std::to_string(i + 1) + ".pbrt\"");
  }
  EXPECT_TRUE(contains(refusal_of("chain0.pbrt"), "nested more than 32 deep"));
  write("many.pbrt", repeated("Include \"empty.pbrt\"\n", 10'001));
  write("empty.pbrt", "");
  EXPECT_TRUE(contains(refusal_of("many.pbrt"), "line 10001: the scene includes more than 10000 files"));
}

TEST_F(HostileScene, NothingIsExpanded) {
  std::string laughs = "<!DOCTYPE lolz [<!ENTITY lol0 \"lol\"><!ENTITY file SYSTEM \"file:///etc/passwd\">";
  for (int i = 1; i < 10; ++i) {
    laughs += "<!ENTITY lol" + std::to_string(i) + " \"" + repeated("&lol" + std::to_string(i - 1) + ";", 10) + "\">";
  }
  const Scene scene =
      scene_of("a.xml", laughs + "]>" + mitsuba("<bsdf type=\"diffuse\" id=\"&lol9;\"/><bsdf type=\"&file;\"/>"));
  ASSERT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.materials[0].material.name, "&lol9;") << "entities stay as they are";
  EXPECT_EQ(scene.unmodelled.count("&file;"), 1U);

  std::string variables = "<default name=\"v0\" value=\"lol\"/>", holders = "<bsdf type=\"diffuse\" id=\"b0\"/>",
              textures = "<texture type=\"bitmap\" id=\"t0\"/>";
  for (int i = 1; i < 100; ++i) {
    const std::string own = std::to_string(i), other = std::to_string(i - 1);
    variables += "<default name=\"v" + own + "\" value=\"" + repeated("$v" + other, 10) + "\"/>";
    holders +=
        "<bsdf type=\"mixturebsdf\" id=\"b" + own + "\">" + repeated("<ref id=\"b" + other + "\"/>", 10) + "</bsdf>";
    if (i < 45)
      textures +=
          "<texture type=\"scale\" id=\"t" + own + "\">" + repeated("<ref id=\"t" + other + "\"/>", 10) + "</texture>";
  }
  EXPECT_TRUE(contains(refusal_of("v.xml", mitsuba(variables)), "longer than 1000 characters"));
  const Scene held = scene_of("b.xml", mitsuba(holders + "<shape><ref id=\"b99\"/></shape>"));
  EXPECT_EQ(held.materials.at(0).uses, std::numeric_limits<std::size_t>::max()) << "10^99 of them";
  const Scene textured =
      scene_of("t.xml", mitsuba(textures + "<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t44\"/></bsdf>"));
  EXPECT_EQ(textured.materials.size(), 1U);
}

TEST_F(HostileScene, CirclesAreRefused) {
  EXPECT_TRUE(contains(refusal_of("a.xml", mitsuba("<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>"
                                                   "<bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>")),
                       "'a' is in a circle of materials that hold one another"));
  EXPECT_TRUE(
      contains(refusal_of("a.xml", mitsuba("<texture type=\"scale\" id=\"t\"><ref id=\"t\"/></texture>"
                                           "<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t\"/></bsdf>")),
               "the texture 't' refers to itself"));
  EXPECT_TRUE(contains(
      refusal_of("a.pbrt", "MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [\"a\" \"a\"]"),
      "'a' is in a circle"));
}

TEST_F(HostileScene, DeepNestingIsRefused) {
  constexpr std::size_t deep = 100'000;
  const auto nested = [](const std::string& open, const std::string& close) {
    return mitsuba(repeated(open, deep) + repeated(close, deep));
  };
  EXPECT_TRUE(contains(refusal_of("a.xml", nested("<bsdf type=\"twosided\">", "</bsdf>")), "nested more than 16 deep"));
  EXPECT_TRUE(contains(refusal_of("a.xml", nested("<shape>", "</shape>")), "nested more than 100 deep"));
  const std::string textures =
      repeated("<texture name=\"value\" type=\"uniform\">", deep) + repeated("</texture>", deep);
  EXPECT_TRUE(
      contains(refusal_of("a.xml", mitsuba("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"uniform\">" +
                                           textures + "</texture></bsdf>")),
               "textures are nested more than 100 deep"));
  EXPECT_TRUE(contains(refusal_of("a.pbrt", repeated("AttributeBegin ", deep)), "nested more than 10000 deep"));
  EXPECT_TRUE(contains(refusal_of("a.rad", "void brightfunc p 0 0 0\n" + repeated("p brightfunc p 0 0 0\n", deep)),
                       "line 17: modifiers are chained more than 16 deep"));
}

TEST_F(HostileScene, MillionsOfMaterialsTakeSeconds) {
  constexpr std::size_t many = 200'000;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(scene_of("a.xml", mitsuba(repeated("<bsdf type=\"diffuse\"/>", many))).materials.size(), many);
  EXPECT_EQ(scene_of("a.pbrt", repeated("Material \"diffuse\"\n", many)).materials.size(), many);
  EXPECT_EQ(scene_of("a.rad", repeated("void plastic a 0 0 5 1 1 1 0 0\n", many)).materials.size(), many);
  const Scene notes = scene_of("b.pbrt", [] {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += "NamedMaterial \"" + std::to_string(i) + "\" Shape \"sphere\"\n";
    return text;
  }());
  EXPECT_EQ(notes.notes.size(), 1001U);
  EXPECT_EQ(notes.notes.back(), "there are 4000 notes more");
  EXPECT_TRUE(contains(refusal_of("c.pbrt", repeated("Material \"x\"\n", 1'000'001)), "more than 1 million materials"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60)) << "a machine under load, too";
  EXPECT_TRUE(contains(refusal_of("d.xml", mitsuba("<bsdf type=\"twosided\" id=\"" + repeated("x", 1001) + "\"/>")),
                       "is longer than 1000 bytes"));
}

TEST_F(HostileScene, NumbersThatAreNone) {
  for (const char* number : {"nan", "NaN", "inf", "-inf", "1e999", "0x10", "1.5.2", "", "1,2"}) {
    const std::string message =
        refusal_of("a.xml", mitsuba("<bsdf type=\"roughconductor\">\n<float name=\"alpha\" value=\"" +
                                    std::string(number) + "\"/></bsdf>"));
    EXPECT_TRUE(message.starts_with("'a.xml', line 2: ")) << message;
    EXPECT_TRUE(contains(message, "alpha")) << message;
  }
  EXPECT_TRUE(
      contains(refusal_of("a.pbrt", "Material \"conductor\" \"float roughness\" [ nan ]"), "roughness = 'nan'"));
  EXPECT_TRUE(contains(refusal_of("a.rad", "void plastic a 0 0 5 .5 .5 .5 .1 nan"), "argument 5 = 'nan'"));
}

TEST_F(HostileScene, MarksLineEndsAndNulBytes) {
  const std::string mark = "\xEF\xBB\xBF", name = "\r\n";
  const Scene xml = scene_of("a.xml", mark + "<scene version=\"0.6.0\">\r\n<bsdf type=\"diffuse\"/>\r\n</scene>");
  EXPECT_EQ(xml.materials.at(0).material.line, 2U);
  const Scene pbrt = scene_of("a.pbrt", mark + "# a\r\nMaterial \"diffuse\"\r\n\"float reflectance\" 0.25\r\n");
  EXPECT_EQ(number(pbrt.materials.at(0), "rho"), 0.25);
  EXPECT_EQ(pbrt.materials.at(0).material.line, 2U);
  const Scene rad = scene_of("a.rad", mark + "!genbox a \\\r\n b\r\nvoid plastic a\r\n0\r\n0\r\n5 .5 .5 .5 0 0\r\n");
  EXPECT_EQ(rad.materials.at(0).material.line, 3U);
  EXPECT_TRUE(has_note(rad, "the command '!genbox a \\' was not run"));
  for (const char* file : {"b.xml", "b.pbrt", "b.rad"}) {
    EXPECT_EQ(refusal_of(file, std::string("\n\n\0", 3)),
              "'" + std::string(file) + "', line 3: there is a NUL byte in the text");
    EXPECT_TRUE(contains(refusal_of(file, "\x1f\x8b abc"), "it is compressed"));
  }
  EXPECT_TRUE(contains(refusal_of("a.obj", "v 0 0 0"), "isn't a scene's file by its ending"));
  EXPECT_EQ(refusal_of("nothing.xml"), "cannot read 'nothing.xml': No such file or directory");
}

TEST_F(HostileScene, TruncatedAndRandomTextEndsInAnAnswer) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.xml", mitsuba("<texture id=\"t\" type=\"checkerboard\"/><bsdf type=\"twosided\" id=\"a\"><bsdf type=\"ward\">"
                        "<ref name=\"specularReflectance\" id=\"t\"/></bsdf></bsdf><shape><ref id=\"a\"/></shape>")},
      {"a.pbrt",
       "Texture \"t\" \"float\" \"constant\" \"float value\" 0.5 Material \"conductor\" \"texture roughness\" \"t\" "
       "Shape \"x\""},
      {"a.rad", "void plastic a 0 0 5 .5 .5 .5 .1 .1\na sphere b 0 0 4 0 0 0 1\n!xform\n"}};
  std::mt19937_64 generator(7);
  std::uniform_int_distribution<int> byte(1, 255);
  for (const auto& [name, text] : files) {
    std::size_t read = 0;
    for (std::size_t i = 0; i <= text.size() + 150; ++i) {
      std::string changed = text.substr(0, i);
      if (i > text.size()) {
        for (int changes = 0; changes < 3; ++changes)
          changed[generator() % text.size()] = static_cast<char>(byte(generator));
      }
      try {
        const Scene scene = scene_of(name, changed);
        std::size_t total = scene.materials.size();
        for (const auto& [type, count] : scene.unmodelled) total += count;
        for (const auto& [type, count] : scene.holders) total += count;
        EXPECT_EQ(total, scene.declared) << changed;
        ++read;
      } catch (const FormatError& error) {
        EXPECT_LT(std::string(error.what()).size(), 600U);
      }
    }
    EXPECT_GT(read, 0U) << "the whole text is one of them";
  }
}

}  // namespace
}  // namespace albedo::analysis
