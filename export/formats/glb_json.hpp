#pragma once
// The chunks of a GLB and the fields of its JSON. Everything comes from a file that is not trusted.

#include "core/little_endian.hpp"
#include "core/text.hpp"
#include "export/formats/glb.hpp"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats::glb {

using Json = nlohmann::json;

inline constexpr std::size_t kMaxJsonBytes = std::size_t{16} << 20;
inline constexpr int kMaxJsonDepth = 32;

/// Thrown within the reader, which turns it into an error of the file.
struct BadGlb : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Chunks {
  std::string_view json, binary;
};

inline Chunks chunks_of(std::string_view file) {
  if (file.size() < kGlbHeaderBytes + kChunkHeaderBytes || load_u32(file.data()) != kMagic)
    throw BadGlb("expected a GLB file, which begins with glTF");
  if (load_u32(file.data() + 4) != kVersion)
    throw BadGlb("expected version 2, found " + std::to_string(load_u32(file.data() + 4)));
  if (load_u32(file.data() + 8) != file.size())
    throw BadGlb("expected " + std::to_string(load_u32(file.data() + 8)) +
                 " bytes by the header, found " + std::to_string(file.size()));
  Chunks chunks;
  for (std::size_t at = kGlbHeaderBytes; at < file.size();) {
    if (file.size() - at < kChunkHeaderBytes) throw BadGlb("the file ends within a chunk");
    const std::size_t size = load_u32(file.data() + at);
    const std::uint32_t type = load_u32(file.data() + at + 4);
    const bool first = at == kGlbHeaderBytes;
    at += kChunkHeaderBytes;
    if (size % 4 != 0)
      throw BadGlb("expected a chunk size that is a multiple of 4, found " + std::to_string(size));
    if (size > file.size() - at) throw BadGlb("the file ends within a chunk");
    if (first != (type == kJsonChunk)) throw BadGlb("expected one JSON chunk, and that first");
    if (first) chunks.json = file.substr(at, size);
    if (type == kBinaryChunk && chunks.binary.data() == nullptr)
      chunks.binary = file.substr(at, size);
    at += size;
  }
  if (chunks.json.size() > kMaxJsonBytes)
    throw BadGlb("expected JSON of at most " + std::to_string(kMaxJsonBytes) + " bytes");
  return chunks;
}

inline Json parsed(std::string_view text) {
  const auto limit = [](int depth, Json::parse_event_t, const Json&) {
    if (depth > kMaxJsonDepth) throw BadGlb("expected JSON nested at most 32 deep, found deeper");
    return true;
  };
  Json json = Json::parse(text, limit);
  if (!json.is_object()) throw BadGlb("expected a JSON object");
  return json;
}

// ---- fields

inline std::size_t count_in(const Json& json, const char* key,
                            std::optional<std::size_t> absent = {}) {
  const auto found = json.find(key);
  if (found == json.end() && absent) return *absent;
  if (found == json.end() || !found->is_number_unsigned())
    throw BadGlb(std::string(key) + ": expected a whole number of 0 or more");
  return found->get<std::size_t>();
}

/// Element `index` of a list of objects.
inline const Json& object_at(const Json& json, const char* list, std::size_t index) {
  const auto found = json.find(list);
  const std::size_t count = found != json.end() && found->is_array() ? found->size() : 0;
  if (index >= count || !(*found)[index].is_object())
    throw BadGlb(std::string(list) + ": " + expected_number("an element", 0, count) + ", found " +
                 std::to_string(index));
  return (*found)[index];
}

/// Whether the element has this extension.
inline bool has_extension(const Json& json, std::string_view name) {
  const auto extensions = json.find("extensions");
  return extensions != json.end() && extensions->is_object() && extensions->contains(name);
}

inline std::vector<double> numbers_in(const Json& json, const char* key,
                                      std::vector<double> absent) {
  const auto found = json.find(key);
  if (found == json.end()) return absent;
  const auto bad = [&] {
    return BadGlb(std::string(key) + ": expected " + std::to_string(absent.size()) + " numbers");
  };
  if (!found->is_array() || found->size() != absent.size()) throw bad();
  for (std::size_t i = 0; i < absent.size(); ++i) {
    if (!(*found)[i].is_number()) throw bad();
    absent[i] = (*found)[i].get<double>();
    if (!std::isfinite(absent[i])) throw bad();
  }
  return absent;
}

}  // namespace clay::solid::inline formats::glb
