#include "export/formats/meshopt_view.hpp"

#include "export/formats/mesh_limits.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace clay::solid::inline formats::glb {
namespace {

constexpr std::size_t kMostPacked = 64;  // bytes in one, in a run of equal vertices

tl::unexpected<Error> bad(std::string_view expected) {
  return failure(ErrorKind::bad_input,
                 std::string("EXT_meshopt_compression: expected ").append(expected));
}

struct Filter {
  std::string_view name;
  void (*decode)(void* buffer, std::size_t count, std::size_t stride);
  std::array<std::size_t, 2> strides;
};
// The exponential filter takes any stride of the mode.
constexpr std::array<Filter, 3> kFilters{{{"OCTAHEDRAL", meshopt_decodeFilterOct, {4, 8}},
                                          {"QUATERNION", meshopt_decodeFilterQuat, {8, 8}},
                                          {"EXPONENTIAL", meshopt_decodeFilterExp, {0, 0}}}};

Result<void> check(std::string_view packed, const MeshoptView& view) {
  const bool attributes = view.mode == "ATTRIBUTES", triangles = view.mode == "TRIANGLES";
  if (!attributes && !triangles && view.mode != "INDICES")
    return bad("the mode ATTRIBUTES, TRIANGLES or INDICES");
  const bool good_stride = attributes
                               ? view.stride > 0 && view.stride <= 256 && view.stride % 4 == 0
                               : view.stride == 2 || view.stride == 4;
  if (!good_stride)
    return bad(attributes ? "a stride of 4 to 256, a multiple of 4" : "indices of 2 or 4 bytes");
  if (triangles && view.count % 3 != 0) return bad("3 indices for each triangle");
  if (!attributes && view.filter != "NONE") return bad("no filter for indices");
  // A triangle and an index take a byte at least, a vertex byte a 64th.
  const std::size_t least =
      attributes ? view.count / kMostPacked * view.stride : view.count / (triangles ? 3 : 1);
  if (view.count == 0 || view.count > kMaxFileBytes / view.stride || least > packed.size())
    return bad("as many elements as its " + std::to_string(packed.size()) +
               " bytes can hold, found " + std::to_string(view.count));
  return {};
}

}  // namespace

Result<std::string> unpacked_by_meshopt(std::string_view packed, const MeshoptView& view) {
  if (auto good = check(packed, view); !good) return tl::make_unexpected(good.error());
  const auto* const filter = std::ranges::find(kFilters, view.filter, &Filter::name);
  if (filter == kFilters.end() && view.filter != "NONE")
    return bad("the filter NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
  if (filter != kFilters.end() && filter->strides[0] != 0 &&
      std::ranges::find(filter->strides, view.stride) == filter->strides.end())
    return bad("another stride for the filter " + std::string(view.filter));
  // Aligned for the filters.
  std::vector<std::uint32_t> unpacked((view.count * view.stride + 3) / 4);
  const auto* const from = reinterpret_cast<const unsigned char*>(packed.data());
  int (*decode)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t) =
      meshopt_decodeVertexBuffer;
  if (view.mode == "TRIANGLES") decode = meshopt_decodeIndexBuffer;
  if (view.mode == "INDICES") decode = meshopt_decodeIndexSequence;
  if (decode(unpacked.data(), view.count, view.stride, from, packed.size()) != 0)
    return bad(std::to_string(view.count) + " elements of " + std::to_string(view.stride) +
               " bytes, found damaged data");
  if (filter != kFilters.end()) filter->decode(unpacked.data(), view.count, view.stride);
  return std::string(reinterpret_cast<const char*>(unpacked.data()), view.count * view.stride);
}

}  // namespace clay::solid::inline formats::glb
