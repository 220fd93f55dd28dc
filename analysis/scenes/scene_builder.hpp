/// @file
/// A Scene in the making, for readers of any format.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "analysis/scenes/scene_value.hpp"

namespace albedo::analysis {

/// Where a BSDF stands, and what it is called.
struct Place {
  std::string name{};
  std::string type{};
  std::string file{};
  std::size_t line = 0;
  std::vector<std::string> within{};
};

/// Collects materials, what isn't modelled, notes, and who uses what. Every BSDF has a number, counted from 0 as they
/// are added.
class SceneBuilder {
 public:
  SceneBuilder(std::string path, std::string format);

  /// A material or, where one of its parameters is outside of its range, an unmodelled BSDF and a note.
  std::size_t add(const MaterialParts& parts, const Place& place);
  /// @param why a note's sentence; none if empty
  std::size_t add_unmodelled(const Place& place, const std::string& why = {});
  std::size_t add_holder(const Place& place);

  /// A sentence about something; said once, with the number of times and the first place.
  void note(const std::string& sentence, const Place& place);
  void note(const std::string& sentence, const std::string& file, std::size_t line) {
    note(sentence, {.file = file, .line = line});
  }

  void use(std::size_t bsdf) { ++bsdfs_[bsdf].uses; }  ///< a shape has it
  void hold(std::size_t holder, std::size_t held) {
    bsdfs_[holder].held.push_back(held);
  }  ///< so do the holder's shapes

  /// @throws FormatError if BSDFs hold one another in a circle
  Scene finish();

 private:
  struct Bsdf {
    std::string name{}, file{};
    std::size_t line = 0;
    std::ptrdiff_t material = -1;  // its index, if it is one
    std::size_t uses = 0;
    std::vector<std::size_t> held{};
  };
  struct Note {
    std::string sentence, first;
    std::size_t count = 0;
  };

  std::size_t add_bsdf(const Place& place);
  void pass_uses_on();

  Scene scene_;
  std::vector<Bsdf> bsdfs_;
  std::vector<Note> notes_;
  std::unordered_map<std::string, std::size_t> note_of_;
  std::size_t notes_left_out_ = 0;
};

}  // namespace albedo::analysis
