#pragma once
// Where the bytes of a file go, and from where they can be read again before they are believed.

#include "claystack/engine/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace clay::solid {

class FileStore {
 public:
  virtual ~FileStore() = default;
  /// Appends. After an error nothing more is written.
  virtual Result<void> write(std::span<const std::byte> bytes) = 0;
  /// False where what has been written is gone (a pipe): then nothing is read.
  [[nodiscard]] virtual bool rereadable() const noexcept = 0;
  /// Fills `bytes` with what was written from `offset` on; from several threads at once. An error
  /// where so much has not been written.
  virtual Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const = 0;
};

/// A file in memory.
class MemoryStore final : public FileStore {
 public:
  Result<void> write(std::span<const std::byte> bytes) override;
  [[nodiscard]] bool rereadable() const noexcept override { return true; }
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const override;
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace clay::solid
