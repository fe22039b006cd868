#pragma once
#include "claystack/core/atomic_file.hpp"
#include "claystack/export/formats.hpp"

#include <utility>

namespace clay::cli {

/// A file under construction that exporters write to and read back.
class FileOnDisk final : public solid::FileStore {
 public:
  explicit FileOnDisk(AtomicFile file) : file_(std::move(file)) {}

  Result<void> write(std::span<const std::byte> bytes) override { return file_.write(bytes); }
  [[nodiscard]] bool rereadable() const noexcept override { return file_.rereadable(); }
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const override {
    return file_.read_at(offset, bytes);
  }
  [[nodiscard]] AtomicFile& file() noexcept { return file_; }

 private:
  AtomicFile file_;
};

}  // namespace clay::cli
