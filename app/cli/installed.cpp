#include "app/cli/installed.hpp"

#include <system_error>

namespace clay::cli {

std::filesystem::path installed(const std::filesystem::path& below_prefix) {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  const auto beside = program.parent_path().parent_path() / below_prefix;
  if (!failed && std::filesystem::exists(beside, failed)) return beside;
  return CLAYSTACK_PREFIX / below_prefix;
}

}  // namespace clay::cli
