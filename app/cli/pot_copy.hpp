#pragma once
// Pots as output files: conversion between encodings, exact or rounded.

#include "claystack/engine/files.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clay::cli {

/// The encoding by file name; empty for files that hold no pots.
[[nodiscard]] std::optional<PotEncoding> pot_encoding_of(std::string_view path);

/// Refuses names of outputs that hold no pot; an empty name and "-" are allowed.
[[nodiscard]] Result<void> check_pot_name(const std::string& path);

/// An error of kind `io` if a pot of this many rings cannot be encoded in the memory that is left:
/// "PATH: writing the pot needs about ...".
[[nodiscard]] Result<void> expect_room_to_write(std::size_t rings, PotEncoding encoding,
                                                const std::string& path);

/// The written copy, for the report.
struct PotCopy {
  PotEncoding encoding = PotEncoding::json;
  std::size_t bytes = 0;
  std::optional<double> rounded_to_mm;
  double change_mm3 = 0.0;  ///< of the counted clay, by rounding
  double change_relative = 0.0;
};

[[nodiscard]] PotCopy describe_copy(const Pot& pot, PotEncoding encoding, std::size_t bytes);
[[nodiscard]] std::string copy_text(const PotCopy& copy, const std::string& path);

}  // namespace clay::cli
