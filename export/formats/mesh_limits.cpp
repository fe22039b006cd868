#include "export/formats/mesh_limits.hpp"

#include "core/text.hpp"
#include "export/formats/file_floats.hpp"

namespace clay::solid::inline formats {

std::optional<std::string> find_bad_coordinate(const glm::vec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    if (is_coordinate(point[axis])) continue;
    std::string what = std::string("expected ").append(kCoordinateRule).append(", found ");
    append_number(what, point[axis]);
    return what;
  }
  return std::nullopt;
}

std::string expected_at_most(std::size_t limit, std::string_view what) {
  return "expected at most " + std::to_string(limit) + ' ' + std::string(what);
}

std::string sufficient_text(double limit) {
  const double unit = std::pow(10.0, std::floor(std::log10(limit)) - 2.0);
  return short_number_text(std::ceil(limit / unit) * unit);
}

tl::unexpected<Error> bad_file(std::string_view name, std::string_view what) {
  return failure(ErrorKind::bad_input, std::string(name).append(": ").append(what));
}

Result<void> check_file_size(std::string_view bytes, std::string_view name) {
  if (bytes.size() <= kMaxFileBytes) return {};
  return bad_file(
      name, expected_at_most(kMaxFileBytes, "bytes") + ", found " + std::to_string(bytes.size()));
}

Result<void> check_text_size(const ByteSource& source, std::size_t usual_bytes,
                             std::string_view name) {
  const std::uint64_t triangles = source.size / usual_bytes;
  if (source.size > kMaxTextBytes)
    return bad_file(name, expected_at_most(kMaxTriangles, "triangles") + ", found about " +
                              std::to_string(triangles / 1'000'000) +
                              " million, by the file's size of " + std::to_string(source.size) +
                              " bytes");
  return source.announce ? source.announce(triangles) : Result<void>();
}

ByteSource source_of(std::string_view bytes) {
  return {[left = bytes](std::span<char> part) mutable -> Result<std::size_t> {
            const std::size_t count = left.copy(part.data(), part.size());
            left.remove_prefix(count);
            return count;
          },
          bytes.size(),
          {}};
}

Result<void> check_facet_count(std::uint64_t facets, std::string_view name) {
  if (facets > 0 && facets <= kMaxTriangles) return {};
  return bad_file(name, "expected 1 to " + std::to_string(kMaxTriangles) + " triangles, found " +
                            std::to_string(facets));
}

}  // namespace clay::solid::inline formats
