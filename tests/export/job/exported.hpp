#pragma once
// Whole jobs, into memory.

#include "claystack/export/job.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid::samples {

/// Every format that this build writes.
inline std::vector<MeshFormat> every_format() {
  std::vector<MeshFormat> formats;
  for (const FormatFacts& facts : kFormatFacts) {
#ifndef CLAYSTACK_DRACO
    if (facts.format == MeshFormat::drc) continue;
#endif
    if (facts.written) formats.push_back(facts.format);
  }
  return formats;
}

struct Exported {
  ExportReport report;
  std::vector<std::string> files;
};

inline Result<Exported> exported(const Pot& pot, const std::vector<MeshFormat>& formats,
                                 const ExportOptions& options,
                                 const std::function<void(std::string_view)>& progress = {}) {
  std::vector<MemoryStore> stores(formats.size());
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < formats.size(); ++i) outputs.push_back({formats[i], &stores[i]});
  return run_export(pot, outputs, options, progress).map([&](ExportReport report) {
    Exported result{std::move(report), {}};
    for (const MemoryStore& store : stores) result.files.push_back(store.bytes());
    return result;
  });
}

}  // namespace clay::solid::samples
