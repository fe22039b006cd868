#include "claystack/export/formats.hpp"
#include "core/base64.hpp"
#include "core/cancel.hpp"
#include "export/formats/zip_package.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using samples::refused;
using samples::tetrahedron;

const std::string kModelStart =
    R"(<?xml version="1.0"?><model unit="millimeter" )"
    R"(xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" )"
    R"(xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" )"
    R"(xmlns:x="urn:x" requiredextensions="m"><metadata name="Title">t</metadata><resources>)";
const std::string kMesh =
    R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="10" y="0" z="0"/>)"
    R"(<vertex x="0" y="10" z="0"/><vertex x="0" y="0" z="10"/></vertices><triangles>)"
    R"(<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>)"
    R"(<triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles></mesh>)";
const std::string kObject = R"(<object id="1" name="a">)" + kMesh + "</object>";
const std::string kBuild = R"(</resources><build><item objectid="1"/></build></model>)";
const std::string kModel = kModelStart + kObject + kBuild;

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TriangleMesh read_model_part(const std::string& xml) {
  const auto mesh = decode_3mf_model(xml, "m");
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh.value_or(TriangleMesh());
}

const std::string kTypesPart =
    R"(<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">)"
    R"(<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.)"
    R"(relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.)"
    R"(3dmanufacturing-3dmodel+xml"/></Types>)";
const std::string kRelationsPart =
    R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
    R"(<Relationship Id="r" Target="/3D/3dmodel.model" )"
    R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";

std::string package_of(const std::string& model, const std::string& relations = kRelationsPart,
                       const std::string& types = kTypesPart) {
  return zipped({{"[Content_Types].xml", types},
                 {"_rels/.rels", relations},
                 {"3D/3dmodel.model", model}})
      .value();
}

// ---- writing

RC_GTEST_PROP(ThreeMf, KeepsEveryBit, ()) {
  TriangleMesh mesh = *samples::any_mesh();
  mesh.points.resize(std::max<std::size_t>(mesh.points.size(), 3));
  mesh.triangles.push_back({0, 1, 2});
  std::erase_if(mesh.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  const FileContents contents{.name = "<any> & \"name\"", .one_body = true, .pot = "pot"};
  const auto read = decode_mesh(encode_mesh(mesh, MeshFormat::three_mf, contents).value(),
                                MeshFormat::three_mf, "x")
                        .value();
  RC_ASSERT(samples::corners_of(read) == samples::corners_of(rounded_to_float(mesh)));
  RC_ASSERT(!samples::has_negative_zero(read));
}

TEST(ThreeMf, IsDeterministicAndCarriesItsParts) {
  const FileContents contents{.notes = {{"process", "porcelain"}},
                              .pot = std::string_view("\xa0\0pot", 5),
                              .thumbnail_png = "png",
                              .certificate = "{}"};
  const std::string bytes = encode_mesh(tetrahedron(), MeshFormat::three_mf, contents).value();
  EXPECT_EQ(bytes, encode_mesh(tetrahedron(), MeshFormat::three_mf, contents).value());
  const PackedParts parts = parts_in_3mf(bytes, "x").value();
  EXPECT_EQ(parts.pot, contents.pot);
  EXPECT_EQ(parts.certificate, "{}");
  const std::string model = model_in_3mf(bytes, "x").value();
  EXPECT_NE(model.find("unit=\"millimeter\""), model.npos);
  EXPECT_NE(model.find("name=\"claystack:process\" preserve=\"1\">porcelain<"), model.npos);
  // A slicer that keeps only the model and its metadata keeps the pot.
  EXPECT_EQ(parts_in_3mf(package_of(model), "x").value().pot, contents.pot);
  // PrusaSlicer keeps neither, but a note.
  const std::string notes =
      ZipPackage::open(bytes, "x")->read("Metadata/Slic3r_PE_model.config", 10'000).value();
  const std::string saved = zipped({{"[Content_Types].xml", kTypesPart},
                                    {"_rels/.rels", kRelationsPart},
                                    {"3D/3dmodel.model", kModel},
                                    {"Metadata/Slic3r_PE_model.config", notes}})
                                .value();
  EXPECT_EQ(parts_in_3mf(saved, "x").value().pot, contents.pot);
  EXPECT_EQ(parts_in_3mf(package_of(kModel), "x").value().pot, "");
  EXPECT_EQ(ZipPackage::open(bytes, "x")->read("Metadata/thumb.png", 10).value(), "png");
}

TEST(ThreeMf, WritesAnObjectForEachBody) {
  // Two tetrahedra; a cavity in the larger one.
  TriangleMesh mesh = tetrahedron();
  const auto add = [&](double scale, const glm::dvec3& shift, bool inward) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const glm::dvec3& p : tetrahedron().points) mesh.points.push_back(scale * p + shift);
    for (auto [a, b, c] : tetrahedron().triangles) {
      if (inward) std::swap(b, c);
      mesh.triangles.push_back({first + a, first + b, first + c});
    }
  };
  add(0.1, glm::dvec3(1.0), true);
  add(1.0, glm::dvec3(50.0, 0.0, 0.0), false);
  const std::string model = encode_3mf_model(mesh, {.name = "pot"}).xml;
  std::size_t objects = 0;
  for (std::size_t at = model.find("<object "); at != model.npos;
       at = model.find("<object ", at + 1))
    ++objects;
  EXPECT_EQ(objects, 3u);  // two bodies and the whole
  for (const char* name : {"name=\"pot part 1\"", "name=\"pot part 2\"", "name=\"pot\""})
    EXPECT_NE(model.find(name), model.npos) << name;
  const TriangleMesh read = read_model_part(model);
  EXPECT_EQ(read.triangles.size(), 12u);
  EXPECT_NEAR(signed_volume(read), (2.0 - 0.001) * 1000.0 / 6.0, 1e-6);
}

TEST(ThreeMf, NumbersThePointsOfEachBodyByThemselves) {
  // Points of two bodies in turn, and one that both use.
  const auto corner = [](std::size_t body, std::size_t i) {
    return tetrahedron().points[i] + glm::dvec3(0.0, 10.0 * static_cast<double>(body), 0.0);
  };
  const TriangleMesh mesh{
      .points = {corner(0, 0), corner(1, 1), corner(0, 1), corner(0, 2), corner(1, 2), corner(0, 3),
                 corner(1, 3)},
      .triangles = {
          {0, 3, 2}, {0, 2, 5}, {2, 3, 5}, {0, 5, 3}, {3, 4, 1}, {3, 1, 6}, {1, 4, 6}, {3, 6, 4}}};
  const TriangleMesh expected{
      .points = {corner(0, 0), corner(0, 1), corner(0, 2), corner(0, 3), corner(1, 1), corner(1, 0),
                 corner(1, 2), corner(1, 3)},
      .triangles = {
          {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {5, 6, 4}, {5, 4, 7}, {4, 6, 7}, {5, 7, 6}}};
  EXPECT_EQ(read_model_part(encode_3mf_model(mesh, {}).xml), expected);
}

TEST(ThreeMf, WritesTheWallMapAsColoursOfCorners) {
  const std::vector<float> walls{0.0F, 5.0F, 10.0F, 40.0F};
  const std::string xml =
      encode_3mf_model(tetrahedron(), {.wall_mm = walls, .wall_top_mm = 10.0}).xml;
  // 65 colours from one end of viridis to the other, ids after those of the objects.
  EXPECT_NE(xml.find("<m:colorgroup id=\"3\">\n<m:color color=\"#440154FF\"/>"), xml.npos);
  EXPECT_NE(xml.find("<m:color color=\"#FDE725FF\"/>\n</m:colorgroup>"), xml.npos);
  std::size_t colours = 0;
  for (std::size_t at = 0; (at = xml.find("<m:color ", at)) != xml.npos; ++at) ++colours;
  EXPECT_EQ(colours, 65u);
  EXPECT_NE(xml.find("pid=\"3\" pindex=\"0\">"), xml.npos);
  EXPECT_NE(xml.find("v1=\"0\" v2=\"1\" v3=\"3\" pid=\"3\" p1=\"0\" p2=\"32\" p3=\"64\"/>"),
            xml.npos);
  EXPECT_NE(xml.find("<metadata name=\"claystack:wall_map\" preserve=\"1\">0 to 10 mm<"), xml.npos);
  EXPECT_EQ(decode_3mf_model(xml, "m").value(), tetrahedron());
}

TEST(Base64, AgreesWithItsStandard) {
  // RFC 4648, section 10.
  for (const auto& [text, code] :
       {std::pair{"", ""}, std::pair{"f", "Zg=="}, std::pair{"fo", "Zm8="},
        std::pair{"foo", "Zm9v"}, std::pair{"foob", "Zm9vYg=="}, std::pair{"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(to_base64(text), code);
    EXPECT_EQ(from_base64(code), text);
  }
  EXPECT_EQ(from_base64("Zm 9v\nYg=="), "foob");
  for (const char* bad : {"Zg", "Zg=", "Z===", "Zg==Zg==", "Zm9*"})
    EXPECT_EQ(from_base64(bad), std::nullopt) << bad;
}

// ---- reading

TEST(ThreeMf, ReadsUnitsComponentsAndTransforms) {
  EXPECT_EQ(read_model_part(kModel), tetrahedron());
  const double volume = 1000.0 / 6.0;
  EXPECT_NEAR(signed_volume(read_model_part(changed(kModel, "millimeter", "inch"))),
              volume * 25.4 * 25.4 * 25.4, 1.0);
  const std::string twice =
      kModelStart + kObject +
      R"(<object id="2"><components><component objectid="1"/>)"
      R"(<component objectid="1" transform="-2 0 0 0 1 0 0 0 1 -5 0 0"/></components></object>)" +
      changed(kBuild, R"(objectid="1")", R"(objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 7")");
  const TriangleMesh read = read_model_part(twice);
  EXPECT_NEAR(signed_volume(read), 3.0 * volume, 1e-9);  // the mirror image faces outward, too
  EXPECT_EQ(read.points[4], glm::dvec3(-5.0, 0.0, 7.0));
  EXPECT_EQ(read.points[5], glm::dvec3(-25.0, 0.0, 7.0));
}

/// A start part whose component is in another part, as Bambu Studio and OrcaSlicer save it.
struct ProductionParts {
  std::string start =
      R"(<model unit="millimeter" requiredextensions="p" )"
      R"(xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" )"
      R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06">)"
      R"(<resources><object id="1" p:UUID="a"><components>)"
      R"(<component p:path="/3D/Objects/O_1.model" objectid="1" )"
      R"(transform="1 0 0 0 1 0 0 0 1 5 0 0"/></components></object></resources>)"
      R"(<build><item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>)"
      R"(<item objectid="1" p:path="/3d/objects/o_1.model"/></build></model>)";
  // The build of the other part has no effect.
  std::string other = changed(kModel, R"(objectid="1")", R"(objectid="7")");
  std::string relations = changed(kRelationsPart, "/3D/3dmodel.model", "/3D/Objects/O_1.model");

  [[nodiscard]] Result<TriangleMesh> read(std::vector<std::string>* notes = nullptr) const {
    const std::string package = zipped({{"[Content_Types].xml", kTypesPart},
                                        {"_rels/.rels", kRelationsPart},
                                        {"3D/3dmodel.model", start},
                                        {"3D/_rels/3dmodel.model.rels", relations},
                                        {"3D/Objects/O_1.model", other}})
                                    .value();
    EXPECT_EQ(
        parts_in_3mf(package, "x").map([](const PackedParts& p) { return p.pot; }).value_or(""),
        "");
    return decode_3mf(package, "x", {.notes = notes});
  }
};

TEST(ThreeMf, ReadsObjectsOfOtherModelParts) {
  const auto mesh = ProductionParts{}.read();
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 8u);
  EXPECT_NEAR(signed_volume(*mesh), 2.0 * 1000.0 / 6.0, 1e-9);
  EXPECT_EQ(mesh->points[1], glm::dvec3(-15.0, 0.0, 0.0));  // moved by 5 mm, then mirrored
  ProductionParts relative;
  relative.relations = changed(relative.relations, "/3D/Objects", "Objects");
  EXPECT_EQ(relative.read().value(), *mesh);
}

TEST(ThreeMf, RefusesPathsThatProductionForbids) {
  const auto expect = [](const ProductionParts& parts, const std::string& because) {
    EXPECT_TRUE(refused(parts.read(), ErrorKind::bad_input, because));
  };
  ProductionParts parts;
  parts.relations = changed(parts.relations, "2013/01/3dmodel", "2013/01/4dmodel");
  expect(parts,
         "path: expected a model part to which this one has a relationship, found "
         "'/3D/Objects/O_1.model'");
  parts = {};
  parts.relations = changed(parts.relations, "O_1", "O_2");
  expect(parts, "expected the part /3D/Objects/O_2.model, found none");
  parts = {};
  parts.start =
      changed(parts.start, R"(objectid="1" transform="1)", R"(objectid="2" transform="1)");
  expect(parts, "objectid: expected an object defined before it, found '2'");
  parts = {};
  parts.other = changed(parts.other, "millimeter", "inch");
  expect(parts, "path: expected a model part in the unit of this one");
  parts = {};
  parts.other = parts.start;
  expect(parts, "path: expected it in the start part only");
  EXPECT_TRUE(refused(decode_3mf_model(parts.start, "m"), ErrorKind::bad_input,
                      "path: expected a model part to which this one has a relationship"));
}

TEST(ThreeMf, PassesOverOtherNamespaces) {
  const std::string file =
      changed(changed(kModel, "<object",
                      R"(<m:colorgroup id="5"><m:color color="#FFF"/></m:colorgroup>)"
                      R"(<basematerials id="6"><base name="a" displaycolor="#FFF"/>)"
                      R"(</basematerials><object pid="6" pindex="0" x:any="1")"),
              R"(v2="2" v3="1")", R"(v2="2" v3="1" pid="5" p1="0" x:paint="4")");
  EXPECT_EQ(read_model_part(file), tetrahedron());
}

TEST(ThreeMf, RefusesWhatTheSpecificationForbids) {
  const auto expect = [](const std::string& from, const std::string& to,
                         const std::string& because) {
    EXPECT_TRUE(
        refused(decode_3mf_model(changed(kModel, from, to), "m"), ErrorKind::bad_input, because))
        << to;
  };
  expect("millimeter", "league", "unit: expected micron");
  expect("v3=\"1\"", "v3=\"4\"", "v3: expected the number of a vertex, from 0 to 3");
  expect("v3=\"1\"", "v3=\"-1\"", "found '-1'");
  expect("v3=\"1\"", "v3=\"2\"", "uses a vertex twice");
  expect(" v3=\"1\"", "", "v3: expected");
  expect("x=\"10\"", "x=\"1,5\"", "x: expected a coordinate");
  expect("x=\"10\"", "x=\"nan\"", "x: expected a coordinate");
  expect("x=\"10\"", "x=\"1e39\"", "x: expected a coordinate");
  expect("id=\"1\"", "id=\"0\"", "expected an id from 1");
  expect("<object", "<basematerials id=\"1\"/><object", "id 1 once, found it twice");
  expect("objectid=\"1\"", "objectid=\"2\"", "an object defined before it");
  expect("id=\"1\" ", "id=\"1\" pid=\"3\" ", "pid: expected the id of a property group");
  expect("<item objectid=\"1\"/>", "", "triangles, found 0");
  expect("id=\"1\" ", "id=\"1\" type=\"pot\" ", "type: expected model");
  expect("id=\"1\" ", "id=\"1\" type=\"other\" ", "found one of type other");
  expect("\"m\"", "\"x\"",
         "expected no required extension but materials and production, found 'urn:x'");
  expect("<mesh>", "<mesh><lattice/>",
         "expected an element of the core specification in mesh, found 'lattice'");
  expect("</mesh>", "</mesh><components/>", "one mesh or one list of components");
  expect("<?xml version=\"1.0\"?>", "<!DOCTYPE model [<!ENTITY a \"b\">]>", "no document type");
  expect("</build>", "", "expected XML, found");
  expect("objectid=\"1\"", "objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"",
         "an invertible matrix");
  expect("objectid=\"1\"", "objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0\"", "12 numbers");
  expect("name=\"Title\">t</metadata>", "name=\"T\"/><metadata name=\"T\"/>",
         "metadata: expected the name 'T' once, found it twice");
  std::string many = "name=\"Title\"/>";
  for (int i = 0; i < 1000; ++i) many += "<metadata name=\"" + std::to_string(i) + "\"/>";
  expect("name=\"Title\">t</metadata>", many, "at most 1000 metadata, found more");
  expect("<resources>", "<resources><metadata name=\"A\"/>",
         "expected 'metadata' in model or metadatagroup, found it in resources");
  expect("<mesh>", "<mesh><item objectid=\"1\"/>", "expected 'item' in build, found it in mesh");
  expect(kBuild,
         R"(<object id="2"><components><component objectid="2"/></components></object>)" + kBuild,
         "an object defined before it");  // a cycle
}

TEST(ThreeMf, RefusesPackagesWithoutAModel) {
  const auto expect = [](const std::string& bytes, const std::string& because) {
    EXPECT_TRUE(refused(decode_3mf(bytes, "p.3mf"), ErrorKind::bad_input, because));
  };
  expect("PK nothing", "expected a zip archive");
  expect(zipped({{"_rels/.rels", kRelationsPart}}).value(), "expected the part of the 3D model");
  expect(package_of(kModel, changed(kRelationsPart, "2013/01/3dmodel", "2013/01/4dmodel")),
         "found no relationship to one");
  expect(
      package_of(
          kModel,
          changed(
              kRelationsPart, "</Rel",
              R"(<Relationship Id="s" )"
              R"(Target="/3D/2.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/)"
              R"(3dmodel"/></Rel)")),
      "expected one 3D model");
  expect(package_of(kModel, kRelationsPart, changed(kTypesPart, "\"model\"", "\"mdl\"")),
         "expected the content type");
  const std::string good = package_of(kModel);
  std::string locked = good;  // the flag of encryption of every entry
  for (const auto& [mark, flags] : {std::pair{"PK\3\4", 6}, {"PK\1\2", 8}})
    for (std::size_t at = 0; (at = locked.find(mark, at)) != locked.npos; at += 4)
      locked[at + static_cast<std::size_t>(flags)] |= 1;
  expect(locked, "cannot unpack");
  EXPECT_EQ(decode_3mf(good, "x").value(), tetrahedron());
  expect(good.substr(0, good.size() - 30), "expected a zip archive");
  EXPECT_TRUE(refused(
      Result<std::string>(zipped({{"a", "1"}, {"A", "2"}})).and_then([](const std::string& zip) {
        return ZipPackage::open(zip, "z").map([](const ZipPackage&) {});
      }),
      ErrorKind::bad_input, "found twice"));
}

TEST(ThreeMf, RefusesARelationshipWhoseIdIsTwiceInTheList) {
  const auto with = [](const std::string& ids) {
    std::string more;
    for (const char id : ids)
      more.append("<Relationship Id=\"").append(1, id).append("\" Target=\"/x\" Type=\"urn:x\"/>");
    return package_of(kModel, changed(kRelationsPart, "</Rel", more + "</Rel"));
  };
  EXPECT_EQ(decode_3mf(with("abcd"), "p").value(), tetrahedron());
  for (const char* ids : {"abca", "abcdr"})  // the model's own is r
    EXPECT_TRUE(refused(decode_3mf(with(ids), "p"), ErrorKind::bad_input,
                        "expected each Id once, found one twice"))
        << ids;
}

TEST(ThreeMf, RefusesTooManyAttributesOfATagInAdvance) {
  const auto with = [](int count) {
    std::string vertex = "<vertex";
    for (int i = 0; i < count; ++i) vertex += "\n x:a" + std::to_string(i) + "='=\">='";
    return changed(kModel, "<vertex", vertex);
  };
  EXPECT_EQ(decode_3mf_model(with(997), "m").value(), tetrahedron());  // and x, y, z
  EXPECT_TRUE(refused(decode_3mf_model(with(998), "m"), ErrorKind::bad_input,
                      "m:999: expected at most 1000 attributes of one tag, found more"));
  EXPECT_TRUE(refused(decode_3mf(package_of(with(998)), "p"), ErrorKind::bad_input,
                      "expected at most 1000 attributes of one tag, found more"));
}

TEST(ThreeMf, IsCancelledWhileItsModelIsRead) {
  std::string model = kModelStart + R"(<object id="1"><mesh><vertices>)";
  for (int i = 0; i < 10'000; ++i) model += R"(<vertex x="0" y="0" z="0"/>)";
  model += R"(</vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)" +
           kBuild;
  ASSERT_TRUE(decode_3mf_model(model, "m"));
  bool no_memory = false;
  std::size_t asked = 0;
  const CancelScope::Question question = [&] {
    ++asked;
    if (no_memory) throw std::bad_alloc();
    return true;
  };
  const CancelScope scope(&question);
  EXPECT_THROW((void)decode_3mf_model(model, "m"), Cancelled);
  EXPECT_EQ(asked, 1U) << "events continue after the first exception";
  no_memory = true;
  EXPECT_TRUE(refused(decode_3mf_model(model, "m"), ErrorKind::io, "not enough memory"));
}

TEST(ThreeMf, NotesSupportsThatAreNotRead) {
  const std::string model = kModelStart + kObject + R"(<object id="2" type="support">)" + kMesh +
                            "</object>" +
                            changed(kBuild, "<build>", R"(<build><item objectid="2"/>)");
  std::vector<std::string> notes;
  ASSERT_TRUE(decode_3mf(package_of(model), "m", {.notes = &notes}));
  EXPECT_EQ(notes, std::vector<std::string>{"1 support item not read"});
}

/// PrusaSlicer leaves them out, too.
TEST(ThreeMf, NotesItemsThatAreNotPrinted) {
  const auto with_items = [](const std::string& items) {
    return kModelStart + kObject + R"(</resources><build>)" + items + "</build></model>";
  };
  const std::string printed = R"(<item objectid="1" printable="1"/>)";
  const std::string left_out = R"(<item objectid="1" printable="0"/>)";
  std::vector<std::string> notes;
  const auto mesh =
      decode_3mf_model(with_items(left_out + printed + left_out), "m", {.notes = &notes});
  EXPECT_EQ(mesh.value(), tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"2 items with printable=\"0\" not read"});
  EXPECT_TRUE(refused(decode_3mf_model(with_items(left_out), "m"), ErrorKind::bad_input,
                      "expected an item to print, found only 1 item with printable=\"0\""));
}

/// A project of a slicer: a model, and a part that names the kinds of volumes.
Result<TriangleMesh> read_project(const std::string& model, std::string_view path,
                                  const std::string& config,
                                  std::vector<std::string>* notes = nullptr) {
  const std::string package = zipped({{"[Content_Types].xml", kTypesPart},
                                      {"_rels/.rels", kRelationsPart},
                                      {"3D/3dmodel.model", model},
                                      {path, config}})
                                  .value();
  return decode_3mf(package, "m", {.notes = notes});
}

/// One mesh for all volumes of an object, as PrusaSlicer writes it: a tetrahedron, and a copy of it
/// with separate points.
std::string two_volumes() {
  return changed(changed(kModel, "</vertices>",
                         R"(<vertex x="90" y="0" z="0"/><vertex x="99" y="0" z="0"/>)"
                         R"(<vertex x="90" y="9" z="0"/><vertex x="90" y="0" z="9"/></vertices>)"),
                 "</triangles>",
                 R"(<triangle v1="4" v2="6" v3="5"/><triangle v1="4" v2="5" v3="7"/>)"
                 R"(<triangle v1="5" v2="6" v3="7"/><triangle v1="4" v2="7" v3="6"/></triangles>)");
}

std::string prusa_config(const std::string& second) {
  return R"(<config><object id="1"><metadata type="object" key="name" value="a"/>)"
         R"(<volume firstid="0" lastid="3"><metadata type="volume" key="volume_type" )"
         R"(value="ModelPart"/></volume><volume firstid="4" lastid="7">)" +
         second + "</volume></object></config>";
}

constexpr std::string_view kPrusaPath = "Metadata/Slic3r_PE_model.config",
                           kBambuPath = "Metadata/model_settings.config";

TEST(ThreeMf, LeavesOutTheVolumesOfPrusaSlicerThatAreNotPrinted) {
  const std::string modifier = R"(<metadata type="volume" key="modifier" value="1"/>)";
  const auto type = [](const std::string& value) {
    return R"(<metadata type="volume" key="volume_type" value=")" + value + R"("/>)";
  };
  const std::pair<std::string, std::string> kinds[] = {
      {modifier + type("ParameterModifier"), "1 modifier or support volume not read"},
      {modifier, "1 modifier or support volume not read"},
      {type("SupportBlocker"), "1 modifier or support volume not read"},
      {type("NegativeVolume"), "1 negative volume not read"}};
  for (const auto& [second, note] : kinds) {
    std::vector<std::string> notes;
    const auto mesh = read_project(two_volumes(), kPrusaPath, prusa_config(second), &notes);
    EXPECT_EQ(mesh.value(), tetrahedron()) << "neither its triangles nor its points";
    EXPECT_EQ(notes, std::vector<std::string>{note});
  }
  std::vector<std::string> notes;
  EXPECT_EQ(read_project(two_volumes(), kPrusaPath, prusa_config(type("ModelPart")), &notes)
                ->triangles.size(),
            8u);
  const std::string other = changed(prusa_config(modifier), R"(object id="1")", R"(object id="2")");
  EXPECT_EQ(read_project(two_volumes(), kPrusaPath, other, &notes)->triangles.size(), 8u);
  EXPECT_TRUE(notes.empty());
  EXPECT_TRUE(
      refused(read_project(two_volumes(), kPrusaPath,
                           changed(prusa_config(modifier), R"(lastid="7")", R"(lastid="3")")),
              ErrorKind::bad_input,
              "m: Metadata/Slic3r_PE_model.config:1: expected the first and the last triangle"));
}

/// Beside the tetrahedron: each object has 20 components of the one before, of which the first has
/// no volume to print. With all their places, 20^30 objects.
TEST(ThreeMf, ReadsNestedComponentsWithoutAVolumeToPrint) {
  constexpr int kLevels = 30, kFirst = 2, kLast = kFirst + kLevels;
  const std::string config =
      R"(<config><object id="2"><volume firstid="0" lastid="3">)"
      R"(<metadata key="volume_type" value="NegativeVolume"/></volume></object></config>)";
  std::string objects = changed(kObject, R"(id="1")", R"(id="2")");
  for (int id = kFirst + 1; id <= kLast; ++id) {
    objects += "<object id=\"" + std::to_string(id) + "\"><components>";
    for (int i = 0; i < 20; ++i)
      objects += "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    objects += "</components></object>";
  }
  const std::string both =
      R"(<item objectid="1"/><item objectid=")" + std::to_string(kLast) + "\"/>";
  const std::string model =
      kModelStart + kObject + objects + changed(kBuild, R"(<item objectid="1"/>)", both);
  EXPECT_EQ(read_project(model, kPrusaPath, config).value(), tetrahedron());
}

TEST(ThreeMf, RefusesAProjectWithoutAVolumeToPrint) {
  const std::string config =
      R"(<config><object id="1"><volume firstid="0" lastid="3">)"
      R"(<metadata key="volume_type" value="SupportEnforcer"/></volume></object></config>)";
  EXPECT_TRUE(refused(read_project(kModel, kPrusaPath, config), ErrorKind::bad_input,
                      "found only 1 modifier or support volume"));
}

TEST(ThreeMf, LeavesOutThePartsOfBambuStudioThatAreNotPrinted) {
  const std::string model =
      kModelStart + kObject + changed(kObject, R"(id="1")", R"(id="2")") +
      R"(<object id="3"><components><component objectid="1"/>)"
      R"(<component objectid="2" transform="1 0 0 0 1 0 0 0 1 90 0 0"/></components></object>)" +
      changed(kBuild, R"(objectid="1")", R"(objectid="3")");
  const auto config = [](const std::string& object, const std::string& kind) {
    return R"(<config><object id=")" + object +
           R"("><part id="1" subtype="normal_part"/><part id="2" subtype=")" + kind +
           R"("/></object></config>)";
  };
  for (const char* kind : {"modifier_part", "support_blocker", "support_enforcer"}) {
    std::vector<std::string> notes;
    EXPECT_EQ(read_project(model, kBambuPath, config("3", kind), &notes).value(), tetrahedron());
    EXPECT_EQ(notes, std::vector<std::string>{"1 modifier or support volume not read"}) << kind;
  }
  std::vector<std::string> notes;
  EXPECT_EQ(read_project(model, kBambuPath, config("3", "negative_part"), &notes).value(),
            tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"1 negative volume not read"});
  const std::string by_itself = changed(model, "</build>", R"(<item objectid="2"/></build>)");
  EXPECT_EQ(read_project(by_itself, kBambuPath, config("3", "modifier_part"))->triangles.size(), 8u)
      << "the object is also an item";
  for (const auto& all : {config("3", "normal_part"), config("4", "modifier_part")})
    EXPECT_EQ(read_project(model, kBambuPath, all)->triangles.size(), 8u);
}

TEST(ThreeMf, LeavesOutTrianglesOfTwoVerticesForRepairs) {
  const std::string model =
      changed(kModel, "<triangles>", R"(<triangles><triangle v1="1" v2="1" v3="3"/>)");
  EXPECT_TRUE(refused(decode_3mf_model(model, "m"), ErrorKind::bad_input, "uses a vertex twice"));
  std::vector<std::string> notes;
  const auto mesh = decode_3mf_model(model, "m", {.repair = true, .notes = &notes});
  EXPECT_EQ(mesh.value(), tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"1 triangle with a vertex twice left out"});
}

TEST(ThreeMf, RefusesBombs) {
  // A model that unpacks to a thousand times its size.
  const std::string blanks(std::size_t{40} << 20, ' ');
  EXPECT_TRUE(refused(decode_3mf(package_of(kModel + blanks), "p"), ErrorKind::bad_input,
                      "expected to unpack to at most 100 times"));
  // 2^31 triangles by components that double.
  std::string doubled = kModelStart + kObject;
  for (int id = 2; id < 31; ++id) {
    const std::string part = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    doubled += "<object id=\"" + std::to_string(id) + "\"><components>" + part + part +
               "</components></object>";
  }
  EXPECT_TRUE(refused(decode_3mf_model(doubled + changed(kBuild, "\"1\"", "\"30\""), "p"),
                      ErrorKind::bad_input, "expected a build of at most 64 times the 4"));
  // A chain of components.
  std::string chain = kModelStart + kObject;
  for (int id = 2; id < 100; ++id)
    chain += "<object id=\"" + std::to_string(id) + "\"><components><component objectid=\"" +
             std::to_string(id - 1) + "\"/></components></object>";
  EXPECT_TRUE(refused(decode_3mf_model(chain + kBuild, "p"), ErrorKind::bad_input,
                      "nested at most 32 deep"));
}

}  // namespace
}  // namespace clay::solid
