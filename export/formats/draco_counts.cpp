#include "export/formats/draco_counts.hpp"

#include "export/formats/draco_metadata.hpp"
#include "export/formats/mesh_limits.hpp"

#include <cstddef>
#include <string>

namespace clay::solid::inline formats {
namespace {

// The layouts differ between versions of the format.
constexpr int kEdgebreaker = 1;
constexpr int kPackedConnectivity = 0x0200, kPackedCounts = 0x0202, kNoNewVertices = 0x0202;

/// Reads the counts in their order; a count beyond the end makes `ended` true.
class CountReader {
 public:
  CountReader(std::string_view bytes, bool packed) : bytes_(bytes), packed_(packed) {}

  std::uint64_t next() { return packed_ ? next_packed() : next_plain(); }

  std::uint64_t byte() {
    if (at_ < bytes_.size()) return static_cast<unsigned char>(bytes_[at_++]);
    ended_ = true;
    return 0;
  }

  [[nodiscard]] bool ended() const { return ended_; }

 private:
  std::uint64_t next_plain() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 32; shift += 8) value |= byte() << shift;
    return value;
  }

  /// Seven bits per byte, the lowest first.
  std::uint64_t next_packed() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint64_t part = byte();
      value |= (part & 0x7FU) << shift;
      if (part < 0x80U) break;
    }
    return value;
  }

  std::string_view bytes_;
  bool packed_;
  std::size_t at_ = kDracoHeaderBytes;
  bool ended_ = false;
};

}  // namespace

Result<DracoCounts> draco_counts(std::string_view bytes, std::string_view name) {
  const auto byte = [bytes](std::size_t at) { return int{static_cast<unsigned char>(bytes[at])}; };
  const int version = 256 * byte(5) + byte(6);
  const bool edgebreaker = byte(8) == kEdgebreaker;
  CountReader reader(bytes, version >= (edgebreaker ? kPackedConnectivity : kPackedCounts));
  DracoCounts counts;
  if (edgebreaker) {
    (void)reader.byte();  // the coding of the traversal
    if (version < kNoNewVertices) (void)reader.next();
    counts.points = reader.next();
    counts.triangles = reader.next();
    (void)reader.byte();  // number of attributes
    (void)reader.next();  // symbols, at most one for each triangle
    counts.points += reader.next();
  } else {
    counts.triangles = reader.next();
    counts.points = reader.next();
  }
  if (reader.ended()) return bad_file(name, "Draco: the counts of the mesh end early");
  if (const auto valid = check_facet_count(counts.triangles, name); !valid)
    return tl::make_unexpected(valid.error());
  if (counts.points > kMaxPoints)
    return bad_file(
        name, expected_at_most(kMaxPoints, "points") + ", found " + std::to_string(counts.points));
  return counts;
}

}  // namespace clay::solid::inline formats
