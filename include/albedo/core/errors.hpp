#pragma once

#include <stdexcept>
#include <string>

namespace albedo {

/// Base of every exception the library throws. Formulas and rules don't throw: not having converged is data in an
/// Estimate.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter, angle or option is unknown, malformed or outside its range; the text names it, its value and the range.
struct ParameterError : Error {
  using Error::Error;
};

/// No model of that name.
struct UnknownModel : Error {
  using Error::Error;
};

/// An input file is unreadable or not in the format it should have.
struct FormatError : Error {
  using Error::Error;
};

/// An output file can't be written.
struct WriteError : Error {
  using Error::Error;
};

}  // namespace albedo
