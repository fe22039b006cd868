#include "stored_file.hpp"

#include "describe.hpp"

namespace clay::solid {

Result<std::string> read_again(const FileStore& store, const std::string& written) {
  if (!store.rereadable()) return written;
  std::string again(written.size(), '\0');
  return store.read_at(0, std::as_writable_bytes(std::span(again))).map([&] {
    return std::move(again);
  });
}

Result<MeshReport> check_stored(const FileStore& store, std::uint64_t bytes, MeshFormat format) {
  const std::string name = as_written(format);
  std::string file(bytes, '\0');
  const auto report = store.read_at(0, std::as_writable_bytes(std::span(file)))
                          .and_then([&] { return decode_mesh(file, format, name); })
                          .map(check_mesh);
  if (!report || report->sound()) return report;
  return failure(ErrorKind::unsound, name + ": found " + describe(report->problems.front()));
}

}  // namespace clay::solid
