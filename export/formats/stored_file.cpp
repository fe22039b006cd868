#include "export/formats/stored_file.hpp"

#include "core/cancel.hpp"

#include <algorithm>

namespace clay::solid::inline formats {

namespace {

constexpr std::size_t kPartBytes = std::size_t{4} << 20;

/// Calls part(bytes, offset) for consecutive parts of `whole`.
template <class Byte, class Part>
Result<void> in_parts(std::span<Byte> whole, Part part) {
  for (std::size_t at = 0; at < whole.size(); at += kPartBytes) {
    stop_if_cancelled();
    const auto bytes = whole.subspan(at, std::min(kPartBytes, whole.size() - at));
    if (auto done = part(bytes, at); !done) return done;
  }
  return {};
}

}  // namespace

Result<void> write_in_parts(FileStore& store, const std::string& bytes) {
  return in_parts(bytes_of(bytes),
                  [&](std::span<const std::byte> part, std::size_t) { return store.write(part); });
}

Result<std::string> read_back(const FileStore& store, const std::string& written) {
  if (!store.rereadable()) return written;
  return read_whole(store, written.size());
}

Result<void> expect_stored(const FileStore& store, const std::string& written, MeshFormat format) {
  return read_back(store, written).and_then([&](const std::string& again) -> Result<void> {
    if (again == written) return {};
    return failure(ErrorKind::io,
                   as_written(format) + ": the bytes read back differ from those written");
  });
}

Result<std::string> read_whole(const FileStore& store, std::uint64_t bytes) {
  std::string file(bytes, '\0');
  return in_parts(
             std::as_writable_bytes(std::span(file)),
             [&](std::span<std::byte> part, std::size_t at) { return store.read_at(at, part); })
      .map([&] { return std::move(file); });
}

}  // namespace clay::solid::inline formats
