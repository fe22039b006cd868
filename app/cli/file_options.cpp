#include "app/cli/file_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::cli {

Result<void> check_file_options(std::span<const FileOption> options,
                                std::span<const solid::FileRequest> files) {
  for (const FileOption& option : options)
    if (option.given && std::ranges::none_of(files, option.fits))
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: expected {} among the files to write, found none",
                                 option.name, option.kind));
  return {};
}

}  // namespace clay::cli
