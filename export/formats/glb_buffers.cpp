#include "export/formats/glb_buffers.hpp"

#include "export/formats/mesh_limits.hpp"
#include "export/formats/meshopt_view.hpp"

#include <algorithm>
#include <utility>

namespace clay::solid::inline formats::glb {
namespace {

/// The meshopt extension of an element, or null.
const Json* meshopt_in(const Json& json) {
  const auto extensions = json.find("extensions");
  if (extensions == json.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(kMeshopt);
  if (found != extensions->end() && !found->is_object())
    throw BadGlb(std::string(kMeshopt) + ": expected an object");
  return found == extensions->end() ? nullptr : &*found;
}

}  // namespace

std::string_view Buffers::view(std::size_t index) {
  const Json& view = object_at(json_, "bufferViews", index);
  const Json* const compressed = meshopt_in(view);
  return compressed == nullptr ? bytes_of(view, index) : unpacked(*compressed, view, index);
}

std::string_view Buffers::stored_view(std::size_t index) const {
  return bytes_of(object_at(json_, "bufferViews", index), index);
}

/// The bytes in the file of a view, or of its extension.
std::string_view Buffers::bytes_of(const Json& view, std::size_t index) const {
  const Json& buffer = object_at(json_, "buffers", count_in(view, "buffer"));
  if (count_in(view, "buffer") != 0 || buffer.contains("uri"))
    throw BadGlb("expected the buffer of the file itself, found another");
  const std::size_t offset = count_in(view, "byteOffset", 0), size = count_in(view, "byteLength");
  if (offset > binary_.size() || size > binary_.size() - offset)
    throw BadGlb("bufferView " + std::to_string(index) + ": expected it within the " +
                 std::to_string(binary_.size()) + " bytes of the buffer");
  return binary_.substr(offset, size);
}

std::string_view Buffers::unpacked(const Json& compressed, const Json& view, std::size_t index) {
  const auto [place, added] = unpacked_.try_emplace(index);
  if (!added) return place->second;
  const std::string place_name = "bufferView " + std::to_string(index) + ": ";
  const std::string mode = compressed.value("mode", ""),
                    filter = compressed.value("filter", "NONE");
  const MeshoptView shape{mode, filter, count_in(compressed, "count"),
                          count_in(compressed, "byteStride")};
  const std::string_view packed = bytes_of(compressed, index);
  if (shape.stride == 0 || shape.count > kMaxFileBytes / shape.stride ||
      shape.count * shape.stride > kMaxFileBytes - unpacked_bytes_)
    throw BadGlb(place_name + "expected at most 1 GiB unpacked");
  if (count_in(view, "byteLength") != shape.count * shape.stride ||
      count_in(view, "byteStride", shape.stride) != shape.stride)
    throw BadGlb(place_name + "expected the length and stride of what it unpacks to, " +
                 std::to_string(shape.count) + " times " + std::to_string(shape.stride));
  unpacked_bytes_ += shape.count * shape.stride;
  auto bytes = unpacked_by_meshopt(packed, shape);
  if (!bytes) throw BadGlb(place_name + bytes.error().message);
  return place->second = std::move(*bytes);
}

Values Buffers::values(const Json& accessor, std::size_t size) {
  if (accessor.contains("sparse")) throw BadGlb("expected no sparse accessor, found one");
  const std::size_t number = count_in(accessor, "bufferView");
  const Json& json = object_at(json_, "bufferViews", number);
  const std::string_view whole = view(number);
  const std::size_t offset = count_in(accessor, "byteOffset", 0);
  const Values found{whole.substr(std::min(offset, whole.size())), count_in(accessor, "count"),
                     count_in(json, "byteStride", size)};
  const std::size_t room = found.bytes.size();
  if (found.count == 0 || found.stride < size || found.stride > 252 || room < size ||
      (found.count - 1) > (room - size) / found.stride)
    throw BadGlb("expected " + std::to_string(found.count) + " values within bufferView " +
                 std::to_string(number));
  return found;
}

}  // namespace clay::solid::inline formats::glb
