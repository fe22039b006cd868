#pragma once
#include "app/cli/batch_pool.hpp"
#include "app/cli/json_output.hpp"
#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace clay::cli {

inline constexpr std::size_t kMaxBatchBytes = std::size_t{256} << 20;
inline constexpr const char* kBatchSchema = "claystack-batch-1";

/// The result of a job in an earlier batch: done, with a verdict.
struct EarlierResult {
  int status = 0;
  bool refused = false;  ///< it ended with an error, and wrote nothing
};

/// The fault in the output of a check that fails: "walls: thin wall ...", "open edge (3): ...".
/// Empty if there is none.
[[nodiscard]] std::string fault_in(const Json& output);

/// The results, one line per job, appended as the jobs end. A killed batch leaves whole lines.
class ResultFile {
 public:
  /// Empty: standard output. Reads what earlier batches wrote.
  static Result<ResultFile> open(const std::string& path);

  ResultFile(ResultFile&& other) noexcept;
  ResultFile& operator=(ResultFile&&) = delete;
  ~ResultFile();

  /// Whether the lines go to standard output, by any of its names.
  [[nodiscard]] bool is_standard_output() const;
  /// The last result of a job that an earlier batch finished. Empty for others, which run again.
  [[nodiscard]] std::optional<EarlierResult> result_of(const BatchJob& job) const;
  Result<void> add(const Json& result);

 private:
  explicit ResultFile(std::string path);
  Result<void> read_done();
  Result<void> read_line(std::string_view line, std::size_t number);
  Result<void> remove_unfinished(std::string_view rest, std::uint64_t size);

  std::string path_;
  int descriptor_ = -1;
  std::map<std::string, EarlierResult> done_;
};

}  // namespace clay::cli
