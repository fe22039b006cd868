#include "export/formats/draco_metadata.hpp"

#include "core/content_hash.hpp"
#include "export/formats/mesh_limits.hpp"

#include <draco/compression/config/compression_shared.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/encoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_encoder.h>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>

namespace clay::solid::inline formats {
namespace {

constexpr std::string_view kPrefix = "claystack.";
constexpr std::string_view kChecksum = "claystack.checksum";
constexpr std::size_t kChecksumDigits = 32;
constexpr std::size_t kFlagsAt = 9;  // two bytes, low byte first
constexpr int kMostNested = 16;

struct Field {
  std::string_view key;
  double DracoClaims::*value;
};
constexpr std::array kFields{
    Field{"claystack.volume_mm3", &DracoClaims::volume_mm3},
    Field{"claystack.volume_bound_mm3", &DracoClaims::volume_bound_mm3},
    Field{"claystack.counted_volume_mm3", &DracoClaims::counted_volume_mm3},
    Field{"claystack.vertex_error_mm", &DracoClaims::vertex_error_mm}};

/// Values by key: views into the file.
using Entries = std::map<std::string_view, std::string_view>;

/// Walks over a block; keeps only entries of Claystack. Every step consumes bytes, so the counts
/// stated in a file cost at most its length.
class MetadataWalk {
 public:
  explicit MetadataWalk(std::string_view bytes) : size_(bytes.size()) {
    in_.Init(bytes.data(), bytes.size());
    in_.Advance(kDracoHeaderBytes);
  }

  /// Returns false if the block is incomplete, nests too deep, or repeats an entry of Claystack.
  bool run() {
    std::uint32_t attributes = 0, id = 0;
    if (!draco::DecodeVarint(&attributes, &in_)) return false;
    for (std::uint32_t i = 0; i < attributes; ++i)
      if (!draco::DecodeVarint(&id, &in_) || !walk(1)) return false;
    return walk(0);
  }

  [[nodiscard]] const Entries& entries() const noexcept { return entries_; }
  [[nodiscard]] std::size_t end() const noexcept {
    return size_ - static_cast<std::size_t>(in_.remaining_size());
  }

 private:
  bool walk(int depth) {
    std::uint32_t entries = 0, nested = 0;
    if (depth > kMostNested || !draco::DecodeVarint(&entries, &in_)) return false;
    for (std::uint32_t i = 0; i < entries; ++i)
      if (!entry()) return false;
    if (!draco::DecodeVarint(&nested, &in_)) return false;
    std::string_view name;
    for (std::uint32_t i = 0; i < nested; ++i)
      if (!short_text(name) || !walk(depth + 1)) return false;
    return true;
  }

  bool entry() {
    std::string_view key, value;
    std::uint32_t size = 0;
    if (!short_text(key) || !draco::DecodeVarint(&size, &in_) || !text(size, value)) return false;
    return !key.starts_with(kPrefix) || entries_.emplace(key, value).second;
  }

  bool short_text(std::string_view& found) {
    std::uint8_t size = 0;
    return in_.Decode(&size) && text(size, found);
  }

  bool text(std::uint32_t size, std::string_view& found) {
    if (in_.remaining_size() < std::int64_t{size}) return false;
    found = {in_.data_head(), size};
    in_.Advance(std::int64_t{size});
    return true;
  }

  std::size_t size_;
  draco::DecoderBuffer in_;
  Entries entries_;
};

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

/// Hash of the whole file without `digits`, a view into it.
ContentHash hash_without(std::string_view bytes, std::string_view digits) {
  const auto at = static_cast<std::size_t>(digits.data() - bytes.data());
  ContentHasher hasher;
  hasher.add(bytes_of(bytes.substr(0, at)));
  hasher.add(bytes_of(bytes.substr(at + digits.size())));
  return hasher.digest();
}

Result<void> check_checksum(std::string_view bytes, const Entries& entries, std::string_view name) {
  const auto stated = entries.find(kChecksum);
  if (stated == entries.end() || stated->second.size() != kChecksumDigits)
    return bad_file(name, "expected a checksum of 32 digits beside other claims, found none");
  const ContentHash found = hash_without(bytes, stated->second);
  if (found == stated->second) return {};
  // The stated value is shown only if it can be a checksum.
  const bool digits = stated->second.find_first_not_of("0123456789abcdef") == std::string::npos;
  return bad_file(name, "checksum: expected " +
                            (digits ? std::string(stated->second) : "hexadecimal digits") +
                            ", found " + found + ": the file has been changed");
}

Result<DracoClaims> read_claims(const Entries& entries, std::string_view name) {
  DracoClaims claims;
  for (const auto& [key, value] : kFields) {
    const auto stated = entries.find(key);
    double number = -1.0;
    if (stated != entries.end() && stated->second.size() == sizeof number)
      std::memcpy(&number, stated->second.data(), sizeof number);
    if (!std::isfinite(number) || number < 0.0)
      return bad_file(name, std::string(key) + ": expected a float64 of 0 or more, found none");
    claims.*value = number;
  }
  return claims;
}

std::uint16_t flags_of(std::string_view bytes) noexcept {
  const auto byte = [bytes](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  return static_cast<std::uint16_t>(byte(kFlagsAt) | byte(kFlagsAt + 1) << 8);
}

void set_flags(std::string& bytes, std::uint16_t flags) noexcept {
  bytes[kFlagsAt] = static_cast<char>(flags & 0xFF);
  bytes[kFlagsAt + 1] = static_cast<char>(flags >> 8);
}

}  // namespace

Result<std::optional<DracoMetadata>> read_draco_metadata(std::string_view bytes,
                                                         std::string_view name) {
  if ((flags_of(bytes) & METADATA_FLAG_MASK) == 0) return std::nullopt;
  MetadataWalk walk(bytes);
  if (!walk.run())
    return bad_file(name,
                    "expected metadata after the header, found a block that ends early, nests "
                    "deeper than 16 or states a claim twice");
  DracoMetadata metadata{walk.end(), std::nullopt};
  if (walk.entries().empty()) return metadata;
  return check_checksum(bytes, walk.entries(), name)
      .and_then([&] { return read_claims(walk.entries(), name); })
      .map([&](const DracoClaims& claims) {
        metadata.claims = claims;
        return std::optional(metadata);
      });
}

std::string with_claims(std::string_view plain, const DracoClaims& claims) {
  draco::GeometryMetadata metadata;
  for (const auto& [key, value] : kFields) metadata.AddEntryDouble(std::string(key), claims.*value);
  metadata.AddEntryString(std::string(kChecksum), std::string(kChecksumDigits, '0'));
  draco::EncoderBuffer block;
  draco::MetadataEncoder().EncodeGeometryMetadata(&block, &metadata);

  std::string bytes(plain.substr(0, kDracoHeaderBytes));
  set_flags(bytes, flags_of(plain) | METADATA_FLAG_MASK);
  bytes.append(block.data(), block.size()).append(plain.substr(kDracoHeaderBytes));
  MetadataWalk walk(bytes);
  walk.run();
  const std::string_view digits = walk.entries().at(kChecksum);
  const auto at = static_cast<std::size_t>(digits.data() - bytes.data());
  return bytes.replace(at, digits.size(), hash_without(bytes, digits));
}

std::string without_metadata(std::string_view bytes, const DracoMetadata& metadata) {
  std::string plain(bytes.substr(0, kDracoHeaderBytes));
  set_flags(plain, static_cast<std::uint16_t>(flags_of(bytes) & ~METADATA_FLAG_MASK));
  return plain.append(bytes.substr(metadata.end));
}

}  // namespace clay::solid::inline formats
