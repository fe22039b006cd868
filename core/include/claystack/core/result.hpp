#pragma once
// Errors that a user can cause are values: what failed, where, and what was expected.

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace clay {

/// The kind sets the exit status of the program.
enum class ErrorKind {
  unsound,    ///< exit 1: the pot or mesh fails a check
  bad_input,  ///< exit 2: bad usage, or a file with invalid contents
  io,         ///< exit 3: could not read or write
  device,     ///< exit 4: a device failed
};

struct Error {
  ErrorKind kind = ErrorKind::bad_input;
  std::string message;  ///< file, place in it, what was expected, what was found
};

template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> failure(ErrorKind kind, std::string message) {
  return tl::make_unexpected(Error{kind, std::move(message)});
}

}  // namespace clay
