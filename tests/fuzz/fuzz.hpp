/// @file
/// What the fuzz targets share. A target is a function of bytes: libFuzzer calls it with bytes of its own making
/// (scripts/fuzz), seeds_test.cpp with those in seeds/ and regressions/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/core/errors.hpp"

namespace albedo::fuzz {

using Target = int (*)(const std::uint8_t* data, std::size_t size);

/// Every target of this program by its name.
inline std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

/// What no input may make false. Whoever calls the target doesn't expect this exception: it ends libFuzzer's program.
inline void require(bool condition, const std::string& what) {
  if (!condition) throw std::logic_error(what);
}

/// Whose text a message may cite.
enum class Cited {
  file,    ///< somebody's: no line ends, nothing that a terminal obeys
  command  ///< the user's own: as it is
};

/// Whether the input is accepted. It may be refused by the documented kind of error alone, in one line of text.
template <class Documented, class Action>
bool accepts(const Action& action, Cited cited = Cited::file) {
  try {
    action();
    return true;
  } catch (const Documented& error) {
    const std::string_view message = error.what();
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
    require(!message.empty() && (cited == Cited::command || std::ranges::none_of(message, is_control)),
            "a message that isn't one line of text: " + std::string(message));
    return false;
  }
}

/// An argument of a command line: there is no NUL byte in one.
inline std::string_view argument(std::string_view text) { return text.substr(0, text.find('\0')); }

/// Words of a command line: the lines of the text.
inline std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  text = argument(text);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace albedo::fuzz

#ifdef ALBEDO_LIBFUZZER
#define ALBEDO_FUZZ_ENTRY(name) \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { return fuzz_##name(data, size); }
#else
#define ALBEDO_FUZZ_ENTRY(name)
#endif

/// Begins the definition of `int fuzz_NAME(std::string_view input)` with a body that ends in `return 0`.
#define ALBEDO_FUZZ_TARGET(name)                                                                  \
  static void run_##name(std::string_view input);                                                 \
  int fuzz_##name(const std::uint8_t* data, std::size_t size);                                    \
  int fuzz_##name(const std::uint8_t* data, std::size_t size) {                                   \
    run_##name(std::string_view(reinterpret_cast<const char*>(data), size));                      \
    return 0;                                                                                     \
  }                                                                                               \
  ALBEDO_FUZZ_ENTRY(name)                                                                         \
  static const bool name##_is_known = albedo::fuzz::targets().emplace(#name, fuzz_##name).second; \
  static void run_##name([[maybe_unused]] std::string_view input)
