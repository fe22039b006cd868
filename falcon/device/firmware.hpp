#pragma once
// The Falcon's processor, a TI C2000, has no permanent program: after each power-up the host sends
// one to its serial boot loader. The program is Novint's and is not part of Claystack: the user
// supplies a file.
//
// Such a file is a boot stream of 16-bit words, low byte first (TI, "TMS320x281x Boot ROM
// Reference Guide", SPRU095, "Boot Loader Data Stream"):
//
//   08AA   key: a stream of bytes
//   0 x 8  reserved
//   entry point, high word and low word
//   blocks: {number of words, address high word, low word, the words}
//   0      the end

#include "claystack/falcon/device.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace clay::falcon::inline device {

/// A complete boot stream.
struct Firmware {
  std::vector<std::uint8_t> bytes;
};

/// Reads the whole stream before any of it is sent; `bad_firmware` names the byte of the fault, and
/// the stream as `name`.
[[nodiscard]] DeviceResult<Firmware> parse_firmware(std::vector<std::uint8_t> bytes,
                                                    const std::string& name);

/// The same for a file of at most 128 kB; `unreadable_firmware` if it is larger or cannot be read.
[[nodiscard]] DeviceResult<Firmware> read_firmware(const std::string& path);

/// Restarts the processor and greets its boot loader, to test whether it has power. `no_answer` if
/// nothing arrives. The line is left in `greeting`.
[[nodiscard]] DeviceResult<void> greet_loader(Transport& line, int attempts = 3);

/// Restarts the processor, sends the program in pieces and compares the echo of each byte. Repeats
/// all of it, up to `attempts` times; the error describes the last attempt. The line is left in
/// `running`.
[[nodiscard]] DeviceResult<void> load_firmware(Transport& line, const Firmware& firmware,
                                               int attempts = 10);

}  // namespace clay::falcon::inline device
