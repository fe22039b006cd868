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
  /// The status of a job that an earlier batch finished: done, with a verdict, by its last result.
  /// Empty for others, which run again.
  [[nodiscard]] std::optional<int> status_of(const BatchJob& job) const;
  Result<void> add(const Json& result);

 private:
  explicit ResultFile(std::string path);
  Result<void> read_done();
  Result<void> read_line(std::string_view line, std::size_t number);
  Result<void> remove_unfinished(std::string_view rest, std::uint64_t size);

  std::string path_;
  int descriptor_ = -1;
  std::map<std::string, int> done_;
};

}  // namespace clay::cli
