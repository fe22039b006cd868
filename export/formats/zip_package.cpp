#include "export/formats/zip_package.hpp"

#include "core/cancel.hpp"
#include "core/lower_case.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"

#include <zip.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace clay::solid::inline formats {
namespace zip {

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
template <class T>
using Owned = std::unique_ptr<T, Discard>;

}  // namespace zip

namespace {

using zip::Owned;

// 1 is the fastest level of deflate: level 6 takes four times as long for a tenth of the size.
constexpr zip_uint32_t kLevel = 1;
constexpr zip_uint16_t kDosDate = 0x21;  // 1980-01-01

tl::unexpected<Error> cannot_zip(std::string_view why) {
  return failure(ErrorKind::io, std::string("cannot make the zip archive: ").append(why));
}

bool add(zip_t* archive, const ZipEntry& entry) {
  zip_source_t* const source =
      zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), 0);
  if (source == nullptr) return false;
  // Paths are ASCII. With ZIP_FL_ENC_UTF_8, libzip 1.11 sets a flag that 1.7 does not.
  const zip_int64_t at =
      zip_file_add(archive, std::string(entry.path).c_str(), source, ZIP_FL_ENC_GUESS);
  if (at < 0) {
    zip_source_free(source);
    return false;
  }
  const auto index = static_cast<zip_uint64_t>(at);
  return zip_file_set_dostime(archive, index, 0, kDosDate, 0) == 0 &&
         zip_set_file_compression(archive, index, entry.compressed ? ZIP_CM_DEFLATE : ZIP_CM_STORE,
                                  kLevel) == 0;
}

Result<std::string> contents_of(zip_source_t* source) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0)
    return cannot_zip("it cannot be read back");
  std::string bytes(stat.size, '\0');
  const zip_int64_t count = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (count != static_cast<zip_int64_t>(bytes.size())) return cannot_zip("it cannot be read back");
  return bytes;
}

constexpr std::size_t kMostShown = 80;  // of a path in a message

}  // namespace

std::string part_key(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  return lower_case(path);
}

Result<std::string> zipped(const std::vector<ZipEntry>& entries) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (source == nullptr) return cannot_zip("not enough memory");
  zip_source_keep(source);  // one for the archive, one to read the result
  const Owned<zip_source_t> result(source);
  Owned<zip_t> archive(zip_open_from_source(source, ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(source);
    return cannot_zip("not enough memory");
  }
  for (const ZipEntry& entry : entries)
    if (!add(archive.get(), entry)) return cannot_zip(zip_strerror(archive.get()));
  if (zip_close(archive.get()) != 0) return cannot_zip(zip_strerror(archive.get()));
  (void)archive.release();
  return contents_of(source);
}

struct ZipPackage::State {
  struct Entry {
    zip_uint64_t index = 0, bytes = 0;
  };
  std::string_view name;
  zip::Owned<zip_t> archive;
  std::map<std::string, Entry> entries;

  Result<void> list() {
    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    if (count < 0 || static_cast<std::uint64_t>(count) > kMaxZipEntries)
      return bad_file(name, "expected at most " + std::to_string(kMaxZipEntries) +
                                " entries in the archive, found " + std::to_string(count));
    for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
      zip_stat_t stat;
      zip_stat_init(&stat);
      constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
      if (zip_stat_index(archive.get(), i, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded)
        return bad_file(name, "entry " + std::to_string(i + 1) + " of the archive is damaged");
      const std::string path = shown(stat.name, kMostShown);
      if (stat.size > kFreeZipBytes && stat.size / kMaxZipRatio > stat.comp_size)
        return bad_file(name, path + ": expected to unpack to at most " +
                                  std::to_string(kMaxZipRatio) + " times its " +
                                  std::to_string(stat.comp_size) + " bytes, found " +
                                  std::to_string(stat.size));
      if (!entries.emplace(part_key(stat.name), Entry{i, stat.size}).second)
        return bad_file(name, path + ": expected once in the archive, found twice");
    }
    return {};
  }

  Result<void> read(const Entry& entry, std::string_view path,
                    const std::function<Result<void>(std::string_view)>& take) const {
    const Owned<zip_file_t> file(zip_fopen_index(archive.get(), entry.index, 0));
    if (!file)
      return bad_file(name,
                      shown(path, kMostShown) + ": cannot unpack: " + zip_strerror(archive.get()));
    std::array<char, std::size_t{1} << 16> piece;
    std::uint64_t left = entry.bytes;
    for (;;) {
      stop_if_cancelled();
      const zip_int64_t count = zip_fread(file.get(), piece.data(), piece.size());
      if (count < 0 || static_cast<std::uint64_t>(count) > left)
        return bad_file(name, shown(path, kMostShown) + ": the archive is damaged here");
      if (count == 0) break;
      left -= static_cast<std::uint64_t>(count);
      if (auto taken = take({piece.data(), static_cast<std::size_t>(count)}); !taken) return taken;
    }
    if (left == 0) return {};
    return bad_file(name, shown(path, kMostShown) + ": the archive ends early");
  }
};

ZipPackage::ZipPackage(std::unique_ptr<State> state) : state_(std::move(state)) {}
ZipPackage::ZipPackage(ZipPackage&&) noexcept = default;
ZipPackage& ZipPackage::operator=(ZipPackage&&) noexcept = default;
ZipPackage::~ZipPackage() = default;

Result<ZipPackage> ZipPackage::open(std::string_view bytes, std::string_view name) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr)
    return failure(ErrorKind::io, std::string(name).append(": not enough memory to read it"));
  Owned<zip_t> archive(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (!archive) {
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    zip_source_free(source);
    return bad_file(name,
                    "expected a zip archive, as 3MF is, found one that cannot be read: " + why);
  }
  auto state = std::make_unique<State>();
  state->name = name;
  state->archive = std::move(archive);
  if (auto listed = state->list(); !listed) return tl::make_unexpected(listed.error());
  return ZipPackage(std::move(state));
}

bool ZipPackage::has(std::string_view path) const {
  return state_->entries.contains(part_key(path));
}

std::uint64_t ZipPackage::bytes_of(std::string_view path) const {
  const auto found = state_->entries.find(part_key(path));
  return found == state_->entries.end() ? 0 : found->second.bytes;
}

Result<void> ZipPackage::read(std::string_view path,
                              const std::function<Result<void>(std::string_view)>& take) const {
  const auto found = state_->entries.find(part_key(path));
  if (found == state_->entries.end())
    return bad_file(state_->name, "expected the part " + shown(path, kMostShown) + ", found none");
  return state_->read(found->second, path, take);
}

Result<std::string> ZipPackage::read(std::string_view path, std::uint64_t most_bytes) const {
  std::string bytes;
  const auto take = [&](std::string_view piece) -> Result<void> {
    if (bytes.size() + piece.size() > most_bytes)
      return bad_file(state_->name, shown(path, kMostShown) + ": expected at most " +
                                        std::to_string(most_bytes) + " bytes, found more");
    bytes += piece;
    return {};
  };
  return read(path, take).map([&] { return std::move(bytes); });
}

}  // namespace clay::solid::inline formats
