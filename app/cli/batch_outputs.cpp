#include "app/cli/batch_outputs.hpp"

#include "app/cli/pot_copy.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/export/job.hpp"
#endif

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

namespace clay::cli {
namespace {

/// Options whose value is a file to write.
constexpr std::array<std::string_view, 7> kOutputs = {
    "-o", "--output", "--record", "--report", "--trace", "--error-plot", "--turntable"};

/// Whether `export` writes a file of this name.
bool is_exported(const std::string& name) {
  if (pot_encoding_of(name)) return true;
#ifdef CLAYSTACK_EXPORT
  return solid::file_request(name).has_value();
#else
  return false;
#endif
}

std::vector<std::string> outputs_of(const std::vector<std::string>& words) {
  std::vector<std::string> outputs;
  const bool exports = words.front() == "export";
  bool input = exports;  // the next file is the pot
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string& word = words[i];
    const std::size_t equals = word.find('=');
    const auto is_output = [](std::string_view option) {
      return std::ranges::find(kOutputs, option) != kOutputs.end();
    };
    if (is_output(word) && i + 1 < words.size())
      outputs.push_back(words[++i]);
    else if (equals != word.npos && is_output(std::string_view(word).substr(0, equals)))
      outputs.push_back(word.substr(equals + 1));
    else if (word.starts_with("-o") && word.size() > 2)
      outputs.push_back(word.substr(2));
    else if (exports && !word.starts_with('-') && is_exported(word) && !std::exchange(input, false))
      outputs.push_back(word);
  }
  std::erase(outputs, "-");
  if (exports && std::ranges::find(words, "--certificate") != words.end())
    for (std::size_t i = 0, count = outputs.size(); i < count; ++i)
      outputs.push_back(outputs[i] + ".certificate.json");
  return outputs;
}

/// A name that is equal for all paths of a file: relative, absolute or through links.
std::string name_of_file(const std::string& output) {
  std::error_code failed;
  const auto absolute = std::filesystem::absolute(output, failed);
  if (!failed) {
    const auto name = std::filesystem::weakly_canonical(absolute, failed);
    if (!failed) return name.string();
  }
  return std::filesystem::path(output).lexically_normal().string();
}

}  // namespace

Result<void> check_job_outputs(const std::vector<BatchJob>& jobs, const std::string& path) {
  std::map<std::string, const BatchJob*> writers;
  for (const BatchJob& job : jobs)
    for (const std::string& output : outputs_of(job.words)) {
      const std::string name = name_of_file(output);
      const auto [writer, first] = writers.emplace(name, &job);
      if (!first && writer->second != &job)
        return failure(ErrorKind::bad_input,
                       path + ": expected a separate output file for each job, found " + output +
                           " written by " + writer->second->id + " and " + job.id);
    }
  return {};
}

}  // namespace clay::cli
