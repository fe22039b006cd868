#pragma once
// The numbers of a GLB: its buffer, views of it, compressed or not, and accessors.

#include "export/formats/glb_json.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace clay::solid::inline formats::glb {

/// Values of one size, a stride apart.
struct Values {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;
  [[nodiscard]] const char* at(std::size_t i) const { return bytes.data() + i * stride; }
};

/// Every function throws BadGlb for data outside the buffer.
class Buffers {
 public:
  /// Both outlive this.
  Buffers(const Json& json, std::string_view binary) : json_(json), binary_(binary) {}

  /// The bytes of a view. One that is compressed by meshopt is unpacked once.
  [[nodiscard]] std::string_view view(std::size_t index);
  /// The same as they are in the file.
  [[nodiscard]] std::string_view stored_view(std::size_t index) const;
  /// The values of an accessor, of `size` bytes each, all within its view.
  [[nodiscard]] Values values(const Json& accessor, std::size_t size);

 private:
  [[nodiscard]] std::string_view bytes_of(const Json& view, std::size_t index) const;
  [[nodiscard]] std::string_view unpacked(const Json& compressed, const Json& view,
                                          std::size_t index);

  const Json& json_;
  std::string_view binary_;
  std::map<std::size_t, std::string> unpacked_;  ///< views by number
  std::size_t unpacked_bytes_ = 0;
};

}  // namespace clay::solid::inline formats::glb
