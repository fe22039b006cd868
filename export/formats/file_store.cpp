#include "claystack/export/formats.hpp"

#include <algorithm>

namespace clay::solid::inline formats {

Result<void> MemoryStore::write(std::span<const std::byte> bytes) {
  bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return {};
}

Result<void> MemoryStore::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (offset > bytes_.size() || bytes.size() > bytes_.size() - offset)
    return failure(ErrorKind::io, "expected " + std::to_string(offset + bytes.size()) +
                                      " bytes in memory, found " + std::to_string(bytes_.size()));
  const auto begin = std::as_bytes(std::span(bytes_)).subspan(offset, bytes.size());
  std::copy(begin.begin(), begin.end(), bytes.begin());
  return {};
}

}  // namespace clay::solid::inline formats
