// The parts of a 3MF package around its model, and the package.

#include "claystack/export/formats.hpp"
#include "core/base64.hpp"
#include "export/formats/three_mf.hpp"
#include "export/formats/three_mf_text.hpp"
#include "export/formats/zip_package.hpp"

#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

using namespace three_mf;

std::string types_xml() {
  std::string text(kDeclaration);
  text.append("<Types xmlns=\"").append(kTypes).append("\">\n");
  for (const auto& [ending, type] :
       {std::pair{"rels", kRelationType}, std::pair{"model", kModelType},
        std::pair{"png", std::string_view("image/png")},
        std::pair{"json", std::string_view("application/json")},
        std::pair{"cbor", std::string_view("application/cbor")},
        std::pair{"config", std::string_view("application/xml")}})
    text.append("<Default Extension=\"")
        .append(ending)
        .append("\" ContentType=\"")
        .append(type)
        .append("\"/>\n");
  return text + "</Types>\n";
}

std::string relations_xml(bool thumbnail) {
  std::string text(kDeclaration);
  text.append("<Relationships xmlns=\"").append(kRelations).append("\">\n");
  const auto add = [&](std::string_view id, std::string_view path, std::string_view type) {
    text.append("<Relationship Id=\"").append(id).append("\" Target=\"/").append(path);
    text.append("\" Type=\"").append(type).append("\"/>\n");
  };
  add("model", kModelPath, kModelRelation);
  if (thumbnail) add("thumbnail", kThumbnailPath, kThumbnailRelation);
  return text + "</Relationships>\n";
}

/// PrusaSlicer needs the volumes of an object of which it reads a setting.
std::string notes_xml(const ModelPart& model, const FileContents& contents) {
  if (contents.pot.empty() || contents.pot.size() > kMostCopiedPotBytes) return {};
  const std::string note = std::string(kPotNote) + to_base64(contents.pot);
  const std::string name = xml_escaped(contents.name);
  std::string text = std::string(kDeclaration) + "<config>\n";
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const std::string own_name = body_name(name, i + 1, model.bodies.size());
    const auto add = [&](std::string_view type, std::string_view key, std::string_view value) {
      text.append("<metadata type=\"").append(type).append("\" key=\"").append(key);
      text.append("\" value=\"").append(value).append("\"/>\n");
    };
    text += "<object id=\"" + std::to_string(i + 1) + "\" instances_count=\"1\">\n";
    add("object", "name", own_name);
    add("object", "notes", note);
    text += "<volume firstid=\"0\" lastid=\"" + std::to_string(model.bodies[i] - 1) + "\">\n";
    add("volume", "name", own_name);
    text += "</volume>\n</object>\n";
  }
  return text + "</config>\n";
}

}  // namespace

Result<std::string> pack_3mf(const ModelPart& model, const FileContents& contents) {
  const std::string types = types_xml(), relations = relations_xml(!contents.thumbnail_png.empty());
  std::vector<ZipEntry> entries{
      {kTypesPath, types}, {kRelationsPath, relations}, {kModelPath, model.xml}};
  if (!contents.thumbnail_png.empty())
    entries.push_back({kThumbnailPath, contents.thumbnail_png, false});
  if (!contents.pot.empty()) entries.push_back({kPotPath, contents.pot});
  const std::string notes = notes_xml(model, contents);
  if (!notes.empty()) entries.push_back({kNotesPath, notes});
  if (!contents.certificate.empty()) entries.push_back({kCertificatePath, contents.certificate});
  return zipped(entries);
}

}  // namespace clay::solid::inline formats
