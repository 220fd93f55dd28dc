#include "analysis/scenes/scene_builder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {
namespace {

// Bounds of what is kept of a hostile file; names are copied from holders to what they hold.
constexpr std::size_t most_notes = 1000, most_bsdfs = 1'000'000, longest_name = 1000;

/// A sum that stays at the largest number instead of starting anew.
std::size_t added(std::size_t a, std::size_t b) {
  const std::size_t most = std::numeric_limits<std::size_t>::max();
  return a > most - b ? most : a + b;
}

}  // namespace

SceneBuilder::SceneBuilder(std::string path, std::string format) {
  scene_.path = std::move(path);
  scene_.format = std::move(format);
}

std::size_t SceneBuilder::add_bsdf(const Place& place) {
  if (++scene_.declared > most_bsdfs) fail_at(place.file, place.line, "the scene has more than 1 million materials");
  if (std::max(place.name.size(), place.type.size()) > longest_name) {
    fail_at(place.file, place.line, "the name " + in_quotes(place.name + place.type) + " is longer than 1000 bytes");
  }
  bsdfs_.push_back({.name = place.name, .file = place.file, .line = place.line});
  return bsdfs_.size() - 1;
}

std::size_t SceneBuilder::add(const MaterialParts& parts, const Place& place) {
  if (!parts.problem().empty()) return add_unmodelled(place, "it isn't modelled: " + parts.problem());
  SceneMaterial material = parts.material();
  for (const ParameterInterval& interval : material.intervals) {
    if (!interval.is_known) {
      note("nothing is known of the texture of " + in_quotes(interval.parameter) +
               ": it takes the whole of its interval",
           place);
    }
  }
  material.material.name = place.name;
  material.material.line = place.line;
  material.file = place.file;
  material.type = place.type;
  material.within = place.within;
  const std::size_t bsdf = add_bsdf(place);
  bsdfs_[bsdf].material = static_cast<std::ptrdiff_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(material));
  return bsdf;
}

std::size_t SceneBuilder::add_unmodelled(const Place& place, const std::string& why) {
  ++scene_.unmodelled[place.type];
  if (!why.empty()) note(place.type + ": " + why, place);
  return add_bsdf(place);
}

std::size_t SceneBuilder::add_holder(const Place& place) {
  ++scene_.holders[place.type];
  return add_bsdf(place);
}

void SceneBuilder::note(const std::string& sentence, const Place& place) {
  const auto known = note_of_.find(sentence);
  if (known != note_of_.end()) {
    ++notes_[known->second].count;
  } else if (notes_.size() == most_notes) {
    ++notes_left_out_;
  } else {
    note_of_.emplace(sentence, notes_.size());
    std::string first = "'" + place.file + "', line " + std::to_string(place.line);
    if (!place.name.empty()) first = in_quotes(place.name) + ", " + first;
    notes_.push_back({sentence, std::move(first), 1});
  }
}

void SceneBuilder::pass_uses_on() {
  std::vector<std::size_t> holders_left(bsdfs_.size()), ready;
  for (const Bsdf& bsdf : bsdfs_) {
    for (const std::size_t held : bsdf.held) ++holders_left[held];
  }
  for (std::size_t i = 0; i < bsdfs_.size(); ++i) {
    if (holders_left[i] == 0) ready.push_back(i);
  }
  std::size_t done = 0;
  for (; done < ready.size(); ++done) {
    const Bsdf& holder = bsdfs_[ready[done]];
    for (const std::size_t held : holder.held) {
      bsdfs_[held].uses = added(bsdfs_[held].uses, holder.uses);
      if (--holders_left[held] == 0) ready.push_back(held);
    }
  }
  if (done == bsdfs_.size()) return;
  for (std::size_t i = 0; i < bsdfs_.size(); ++i) {
    if (holders_left[i] == 0) continue;
    fail_at(bsdfs_[i].file, bsdfs_[i].line,
            in_quotes(bsdfs_[i].name) + " is in a circle of materials that hold one another");
  }
}

Scene SceneBuilder::finish() {
  pass_uses_on();
  for (const Bsdf& bsdf : bsdfs_) {
    if (bsdf.material >= 0) scene_.materials[static_cast<std::size_t>(bsdf.material)].uses = bsdf.uses;
  }
  for (const Note& note : notes_) {
    const std::string where = note.count == 1 ? note.first : std::to_string(note.count) + " times, first " + note.first;
    scene_.notes.push_back(note.sentence + " (" + where + ")");
  }
  if (notes_left_out_ > 0) scene_.notes.push_back("there are " + std::to_string(notes_left_out_) + " notes more");
  return std::move(scene_);
}

}  // namespace albedo::analysis
