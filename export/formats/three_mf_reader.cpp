#include "claystack/export/formats.hpp"
#include "core/base64.hpp"
#include "core/lower_case.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/stated_sizes.hpp"
#include "export/formats/three_mf.hpp"
#include "export/formats/three_mf_check.hpp"
#include "export/formats/three_mf_model.hpp"
#include "export/formats/xml_reader.hpp"
#include "export/formats/zip_package.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

namespace clay::solid::inline formats {
namespace {

using namespace three_mf;

constexpr std::uint64_t kMaxListBytes = std::uint64_t{4} << 20;  // of content types, relationships
constexpr std::uint64_t kMaxPotBytes = std::uint64_t{1} << 30;

/// Passes on every element of a small XML file.
class Elements final : public XmlReader::Events {
 public:
  using Visit = std::function<void(XmlReader&, const XmlElement&)>;
  explicit Elements(Visit visit) : visit_(std::move(visit)) {}
  void begin(XmlReader& reader, const XmlElement& element) override { visit_(reader, element); }
  void end(XmlReader&) override {}
  void text(XmlReader&, std::string_view) override {}

 private:
  Visit visit_;
};

Result<void> each_element(const ZipPackage& package, std::string_view path, std::string_view name,
                          const Elements::Visit& visit, std::uint64_t most_bytes = kMaxListBytes) {
  return package.read(path, most_bytes).and_then([&](const std::string& xml) {
    const std::string place = std::string(name).append(": ").append(path);
    Elements events(visit);
    XmlReader reader(events, place);
    return reader.read(xml).and_then([&] { return reader.finish(); });
  });
}

bool ends_like(std::string_view path, std::string_view ending) {
  return path.size() > ending.size() && path[path.size() - ending.size() - 1] == '.' &&
         std::ranges::equal(path.substr(path.size() - ending.size()), ending,
                            [](char a, char b) { return lower_case(a) == lower_case(b); });
}

/// The path of the start part, which must be one model of the type that the package states.
Result<std::string> model_path(const ZipPackage& package, std::string_view name) {
  std::string path;
  std::unordered_set<std::string> ids;
  auto found = each_element(package, kRelationsPath, name,
                            [&](XmlReader& reader, const XmlElement& element) {
                              if (element.name != "Relationship") return;
                              if (!ids.emplace(element.value_of("Id").value_or("")).second)
                                return reader.fail("expected each Id once, found one twice");
                              if (element.value_of("Type") != kModelRelation) return;
                              if (!path.empty())
                                return reader.fail("expected one 3D model, found several");
                              path = element.value_of("Target").value_or("");
                            });
  if (!found) return tl::make_unexpected(found.error());
  if (path.empty() || !package.has(path))
    return bad_file(name, std::string("expected the part of the 3D model, found ") +
                              (path.empty() ? "no relationship to one" : "none"));
  bool known = false;
  found = each_element(package, kTypesPath, name, [&](XmlReader&, const XmlElement& element) {
    const std::string_view ending = element.value_of("Extension").value_or("");
    const bool names_it =
        (element.name == "Default" && !ending.empty() && ends_like(path, ending)) ||
        (element.name == "Override" &&
         element.value_of("PartName")
             .value_or("")
             .ends_with(path.starts_with('/') ? path.substr(1) : path));
    known = known || (names_it && element.value_of("ContentType") == kModelType);
  });
  if (!found) return tl::make_unexpected(found.error());
  if (!known)
    return bad_file(name, std::string("expected the content type ").append(kModelType) +
                              " for the part of the 3D model, found none");
  return path;
}

/// Calls `use(package, path of the model)`.
template <class Use>
auto with_model(std::string_view bytes, std::string_view name, Use use)
    -> decltype(use(std::declval<const ZipPackage&>(), std::string())) {
  return guarded(name, [&] {
    return check_file_size(bytes, name)
        .and_then([&] { return ZipPackage::open(bytes, name); })
        .and_then([&](const ZipPackage& package) {
          return model_path(package, name).and_then([&](const std::string& path) {
            return use(package, path);
          });
        });
  });
}

Result<void> read_part(const ZipPackage& package, std::string_view path, std::string_view name,
                       XmlReader::Events& events) {
  const std::string place = std::string(name).append(": ").append(path);
  XmlReader reader(events, place);
  return package.read(path, [&](std::string_view piece) { return reader.read(piece); })
      .and_then([&] { return reader.finish(); });
}

/// The model parts to which the start part has a relationship. Slicers such as Bambu Studio keep
/// each object in a separate part.
Result<std::vector<std::string>> other_parts(const ZipPackage& package, const std::string& path,
                                             std::string_view name) {
  const std::size_t file = path.rfind('/') + 1;
  const std::string folder = path.substr(0, file);
  const std::string relations = folder + "_rels/" + path.substr(file) + ".rels";
  std::vector<std::string> paths;
  if (!package.has(relations)) return paths;
  std::unordered_set<std::string> known{part_key(path)};
  return each_element(package, relations, name,
                      [&](XmlReader&, const XmlElement& element) {
                        if (element.value_of("Type") != kModelRelation) return;
                        std::string target(element.value_of("Target").value_or(""));
                        if (!target.starts_with('/')) target.insert(0, folder);
                        if (known.insert(part_key(target)).second) paths.push_back(target);
                      })
      .map([&] { return std::move(paths); });
}

/// The other parts first: the start part uses their objects.
Result<void> read_model(const ZipPackage& package, const std::string& path, std::string_view name,
                        ModelReader& model) {
  return other_parts(package, path, name)
      .and_then([&](const std::vector<std::string>& others) {
        Result<void> read;
        for (const std::string& other : others) {
          if (!read) break;
          model.begin_other(other);
          read = read_part(package, other, name, model);
          model.end_other();
        }
        return read;
      })
      .and_then([&] { return read_part(package, path, name, model); });
}

/// Of the project of a slicer; none in other packages. Read piece by piece: the notes of many
/// bodies with their pot are long.
Result<SlicerVolumes> slicer_volumes(const ZipPackage& package, std::string_view name) {
  SlicerVolumes volumes;
  for (const std::string_view path : {kNotesPath, kSettingsPath}) {
    if (!package.has(path)) continue;
    Elements events(
        [&](XmlReader& reader, const XmlElement& element) { volumes.visit(reader, element); });
    if (auto read = read_part(package, path, name, events); !read)
      return tl::make_unexpected(read.error());
  }
  return volumes;
}

/// The text of the first note that holds a pot; empty: there is none.
Result<std::string> pot_note(const ZipPackage& package, std::string_view name) {
  std::string text;
  constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20;
  return each_element(
             package, kNotesPath, name,
             [&](XmlReader&, const XmlElement& element) {
               const std::string_view value = element.value_of("value").value_or("");
               if (!text.empty() || element.value_of("key") != "notes") return;
               if (value.starts_with(kPotNote)) text = value.substr(kPotNote.size());
             },
             kMostBytes)
      .map([&] { return std::move(text); });
}

}  // namespace

Result<TriangleMesh> decode_3mf(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return with_model(bytes, name, [&](const ZipPackage& package, const std::string& path) {
    return slicer_volumes(package, name).and_then([&](SlicerVolumes volumes) {
      ModelReader model(options, std::move(volumes));
      return read_model(package, path, name, model).and_then([&] { return model.build(name); });
    });
  });
}

Result<TriangleMesh> decode_3mf_model(std::string_view xml, std::string_view name,
                                      const ReadOptions& options) {
  return guarded(name, [&] {
    return check_file_size(xml, name).and_then([&] {
      ModelReader model(options);
      XmlReader reader(model, name);
      Result<void> read;
      constexpr std::size_t kPiece = std::size_t{1} << 20;
      for (std::size_t at = 0; read && at < xml.size(); at += kPiece)
        read = reader.read(xml.substr(at, kPiece));
      return read.and_then([&] { return reader.finish(); }).and_then([&] {
        return model.build(name);
      });
    });
  });
}

std::uint64_t bytes_of_models_in_3mf(std::string_view bytes) {
  return with_model(bytes, {},
                    [](const ZipPackage& package, const std::string& path) {
                      return other_parts(package, path, {}).map([&](const auto& others) {
                        std::uint64_t sum = package.bytes_of(path);
                        for (const std::string& other : others) sum += package.bytes_of(other);
                        return sum;
                      });
                    })
      .value_or(0);
}

Result<PackedParts> parts_in_3mf(std::string_view bytes, std::string_view name) {
  return with_model(
      bytes, name, [&](const ZipPackage& package, const std::string& path) -> Result<PackedParts> {
        PackedParts parts;
        if (package.has(kCertificatePath)) {
          auto certificate = package.read(kCertificatePath, kMaxFileBytes);
          if (!certificate) return tl::make_unexpected(certificate.error());
          parts.certificate = std::move(*certificate);
        }
        if (package.has(kPotPath)) {
          auto pot = package.read(kPotPath, kMaxPotBytes);
          if (!pot) return tl::make_unexpected(pot.error());
          parts.pot = std::move(*pot);
          return parts;
        }
        ModelReader model({});
        if (auto read = read_model(package, path, name, model); !read)
          return tl::make_unexpected(read.error());
        std::string text = model.pot_text();
        if (text.empty() && package.has(kNotesPath)) {
          auto note = pot_note(package, name);
          if (!note) return tl::make_unexpected(note.error());
          text = std::move(*note);
        }
        const auto pot = from_base64(text);
        if (!pot)
          return bad_file(name, std::string(kPotMetadata) + ": expected base64, found other text");
        parts.pot = *pot;
        return parts;
      });
}

Result<std::string> model_in_3mf(std::string_view bytes, std::string_view name) {
  return with_model(bytes, name, [&](const ZipPackage& package, const std::string& path) {
    return package.read(path, kMaxFileBytes);
  });
}

Result<void> check_model_in_3mf(std::string_view bytes, std::string_view model,
                                std::string_view name) {
  const auto other = [&] {
    return failure(ErrorKind::unsound,
                   std::string(name).append(": the model part is not the one that was packed"));
  };
  return with_model(bytes, name, [&](const ZipPackage& package, const std::string& path) {
    std::string_view left = model;
    return package
        .read(path,
              [&](std::string_view piece) -> Result<void> {
                if (!left.starts_with(piece)) return other();
                left.remove_prefix(piece.size());
                return {};
              })
        .and_then([&]() -> Result<void> {
          if (left.empty()) return {};
          return other();
        });
  });
}

}  // namespace clay::solid::inline formats
