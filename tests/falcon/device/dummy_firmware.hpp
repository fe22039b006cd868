#pragma once
// A harmless program for no processor, in the container format of real ones.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace clay::falcon {

/// Little-endian 16-bit words: key, 8 zeros, entry point 003F:8002, blocks, 0.
inline std::vector<std::uint8_t> dummy_firmware(std::size_t words_in_block = 300,
                                                std::size_t blocks = 3) {
  std::vector<std::uint8_t> bytes;
  const auto put = [&bytes](std::size_t word) {
    bytes.push_back(static_cast<std::uint8_t>(word % 256));
    bytes.push_back(static_cast<std::uint8_t>(word / 256 % 256));
  };
  put(0x08AA);
  for (int i = 0; i < 8; ++i) put(0);
  put(0x003F);
  put(0x8002);
  for (std::size_t block = 0; block < blocks; ++block) {
    put(words_in_block);
    put(0x003F);
    put(0x8000 + block * words_in_block);
    for (std::size_t i = 0; i < words_in_block; ++i) put(i * 40503 + block);
  }
  put(0);
  return bytes;
}

}  // namespace clay::falcon
