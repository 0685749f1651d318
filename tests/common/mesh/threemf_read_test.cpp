// 3MF as slicers and CAD write it, and as strangers might: what is read, where it lies, and what is refused by name.
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/mesh/scene_file.h"
#include "common/mesh/threemf_model.h"
#include "tests/common/zip_file.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace threemf_read_test {

constexpr const char* kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr const char* kProduction =
    "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\"";
constexpr const char* kRoot = "3D/3dmodel.model";

/// A cuboid from the origin, in the file's unit, its triangles looking outwards.
std::string cuboid(double x, double y, double z) {
  std::string xml = "<mesh><vertices>";
  for (int i = 0; i < 8; ++i)
    xml += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0);
  xml += "</vertices><triangles>";
  constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& face : kFaces)
    xml += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>", face[0], face[1], face[2]);
  return xml + "</triangles></mesh>";
}

std::string object(int id, const std::string& content, const std::string& attributes = "") {
  return fmt::format("<object id=\"{}\" {}>{}</object>", id, attributes, content);
}

std::string model(const std::string& objects, const std::string& items, const std::string& attributes = "") {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model xmlns=\"{}\" "
      "{}><resources>{}</resources><build>{}</build></model>",
      kCore, attributes, objects, items);
}

std::string relationships(const std::string& target, const std::string& more = "") {
  return "<?xml version=\"1.0\"?><Relationships "
         "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">" +
         more + "<Relationship Target=\"" + target +
         "\" Id=\"rel0\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
}

NamedFiles package(const std::string& root, const NamedFiles& others = {}) {
  NamedFiles files{{"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", relationships("/3D/3dmodel.model")}};
  files.insert(files.end(), others.begin(), others.end());
  files.emplace_back(kRoot, root);
  return files;
}

const std::string kBox = object(1, cuboid(10, 20, 30)), kItem = "<item objectid=\"1\"/>";

class ThreeMf : public ::testing::Test {
 protected:
  SceneMesh read_bytes(const std::string& bytes) { return read_scene_file(scratch_.file("a.3mf", bytes)); }
  SceneMesh read(const NamedFiles& files) { return read_bytes(zip_of(files)); }
  /// Least and most corner of all, in the file's unit.
  std::vector<double> extent(const NamedFiles& files) {
    const Positions p = read(files).mesh.positions;
    return {p.col(0).minCoeff(), p.col(1).minCoeff(), p.col(2).minCoeff(),
            p.col(0).maxCoeff(), p.col(1).maxCoeff(), p.col(2).maxCoeff()};
  }
  std::string error_of_bytes(const std::string& bytes) {
    std::string text = message_of<DataError>([&] { read_bytes(bytes); });
    const std::string folder = (scratch_ / "").string();
    return text.starts_with(folder) ? text.substr(folder.size()) : "not refused, or without its name: " + text;
  }
  std::string error(const NamedFiles& files) { return error_of_bytes(zip_of(files)); }

  ScratchFolder scratch_;
};

TEST_F(ThreeMf, PicturesAndOtherFilesInsideChangeNothing) {
  const SceneMesh plain = read(package(model(kBox, kItem)));
  EXPECT_EQ(plain.unit, "mm");
  EXPECT_EQ(plain.mesh.num_vertices(), 8);
  EXPECT_EQ(plain.mesh.num_triangles(), 12);
  EXPECT_NEAR(signed_volume(plain.mesh), 6000.0, 1e-9);
  const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  const std::string thumbnail =
      "<Relationship Target=\"/Metadata/thumbnail.png\" Id=\"rel1\" "
      "Type=\"http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\"/>";
  NamedFiles with_thumbnail = package(model(kBox, kItem), {{"Metadata/thumbnail.png", png}});
  with_thumbnail[1].second = relationships("/3D/3dmodel.model", thumbnail);
  const NamedFiles with_texture =
      package(model("<m:texture2d xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" id=\"9\" "
                    "path=\"/3D/Textures/a.jpg\" contenttype=\"image/jpeg\"/>" +
                        kBox,
                    kItem),
              {{"3D/Textures/a.jpg", "\xFF\xD8\xFF\xE0 no picture"},
               {"3D/_rels/3dmodel.model.rels", relationships("/3D/Textures/a.jpg")}});
  const NamedFiles with_plates =
      package(model(kBox, kItem, "xmlns:BambuStudio=\"http://schemas.bambulab.com/package/2021\""),
              {{"Metadata/plate_1.png", ""},
               {"Metadata/plate_1.gcode", std::string(100'000, 'G')},
               {"Metadata/project_settings.config", "{\"a\": 1"}});
  for (const NamedFiles& files : {with_thumbnail, with_texture, with_plates})
    for (const ZipMethod method : {ZipMethod::store, ZipMethod::deflate}) {
      const SceneMesh mesh = read_bytes(zip_of(files, method));
      EXPECT_EQ(mesh.mesh.positions, plain.mesh.positions);
      EXPECT_EQ(mesh.mesh.triangles, plain.mesh.triangles);
    }
}

TEST_F(ThreeMf, PartsByPathAreReadFromTheirPart) {
  const std::string part =
      model(object(1, cuboid(10, 10, 2)) + object(7, cuboid(1, 1, 1)), "<item objectid=\"99\"/>", kProduction);
  const std::string at = "transform=\"1 0 0 0 1 0 0 0 1 50 0 0\"";
  const NamedFiles others{{"3D/Objects/part 1.model", part}};
  const auto root = [&](const std::string& objects, const std::string& items) {
    return package(model(objects, items, kProduction), others);
  };
  // An item by path, whose number the root has too.
  EXPECT_EQ(extent(root(kBox, "<item objectid=\"1\" p:path=\"/3D/Objects/part 1.model\"/>")),
            (std::vector<double>{0, 0, 0, 10, 10, 2}));
  // A component by path beside one of the root's.
  EXPECT_EQ(extent(root(kBox + object(2,
                                      "<components><component objectid=\"1\"/><component objectid=\"7\" "
                                      "p:path=\"/3D/Objects/part 1.model\" " +
                                          at + "/></components>"),
                        "<item objectid=\"2\"/>")),
            (std::vector<double>{0, 0, 0, 51, 20, 30}));
  // All by path; names as packages may write them; the prefix is the file's choice.
  EXPECT_EQ(extent(package(model("", "<item objectid=\"7\" q:path=\"/3d/objects/Part%201.model\"/>",
                                 "xmlns:q=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\""),
                           others)),
            (std::vector<double>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(read(root(kBox, kItem + "<item objectid=\"7\" p:path=\"/3D/Objects/part 1.model\" " + at + "/>"))
                .mesh.num_triangles(),
            24);
}

TEST_F(ThreeMf, PathsThatLeadNowhereAreRefused) {
  const auto by_path = [&](const std::string& path, const NamedFiles& others) {
    return package(model(kBox, "<item objectid=\"4\" p:path=\"" + path + "\"/>", kProduction), others);
  };
  EXPECT_EQ(error(by_path("/3D/b.model", {})),
            "a.3mf: 3D/3dmodel.model: names the part /3D/b.model, which is not there");
  EXPECT_EQ(error(by_path("/3D/b.model", {{"3D/b.model", model(kBox, "")}})),
            "a.3mf: 3D/b.model: has no object 4, which the root model names");
  EXPECT_EQ(
      error(by_path("/3D/b.model",
                    {{"3D/b.model",
                      model(object(4, "<components><component objectid=\"1\" p:path=\"/3D/c.model\"/></components>"),
                            "", kProduction)}})),
      "a.3mf: 3D/b.model: names another part, /3D/c.model, as only the root model may");
  EXPECT_EQ(error(by_path("/3D/b.model", {{"3D/b.model", model(object(4, cuboid(1, 1, 1)), "", "unit=\"inch\"")}})),
            "a.3mf: 3D/b.model: its unit is in, that of the root model mm");
  EXPECT_EQ(error(package(model(kBox, "<item objectid=\"1\" p:path=\"/3D/b.model\"/>", "xmlns:p=\"http://another\""))),
            "a.3mf: 3D/3dmodel.model: p:path of <item> is not the path of "
            "http://schemas.microsoft.com/3dmanufacturing/production/2015/06");
}

TEST_F(ThreeMf, TheUnitIsThatOfTheRootModel) {
  const auto unit = [&](const std::string& attributes) {
    const std::string other = model(object(1, cuboid(1, 1, 1)), "", "unit=\"inch\"");
    return read(package(model(kBox, kItem, attributes), {{"3D/Objects/unused.model", other}})).unit;
  };
  for (const auto& [word, is] : std::vector<std::pair<std::string, std::string>>{{"micron", "um"},
                                                                                 {"millimeter", "mm"},
                                                                                 {"centimeter", "cm"},
                                                                                 {"inch", "in"},
                                                                                 {"foot", "ft"},
                                                                                 {"meter", "m"}})
    EXPECT_EQ(unit("unit=\"" + word + "\""), is);
  EXPECT_EQ(unit(""), "mm");
  EXPECT_EQ(metres_per_unit("ft"), 0.3048);
  EXPECT_EQ(error(package(model(kBox, kItem, "unit=\"furlong\""))),
            "a.3mf: 3D/3dmodel.model: unit 'furlong' is none of micron, millimeter, centimeter, inch, foot, meter");
  // The root is what the relationships name, whatever else the archive has.
  NamedFiles files = package(model(object(1, cuboid(5, 5, 5)), kItem, "unit=\"meter\""),
                             {{"3D/other.model", model(kBox, kItem, "unit=\"inch\"")}});
  files[1].second = relationships("3D/other.model");
  EXPECT_EQ(read(files).unit, "in");
  EXPECT_EQ(extent(files), (std::vector<double>{0, 0, 0, 10, 20, 30}));
}

TEST_F(ThreeMf, PlacementsAreAppliedFromTheInsideOut) {
  const auto placed = [&](const std::string& item, const std::string& component) {
    return package(
        model(kBox + object(2, "<components><component objectid=\"1\" transform=\"" + component + "\"/></components>"),
              "<item objectid=\"2\" transform=\"" + item + "\"/>"));
  };
  // A quarter turn about z takes x to y (points are rows); then a shift. The other way round it lies elsewhere.
  const std::string turn = "0 1 0 -1 0 0 0 0 1 0 0 0", shift = " 1 0 0  0 1 0 0 0 1\n100 0 +0.5";
  EXPECT_EQ(extent(placed(shift, turn)), (std::vector<double>{80, 0, 0.5, 100, 10, 30.5}));
  EXPECT_EQ(extent(placed(turn, shift)), (std::vector<double>{-20, 100, 0.5, 0, 110, 30.5}));
  // A mirrored part keeps its outside.
  EXPECT_NEAR(signed_volume(read(placed("-2 0 0 0 1 0 0 0 1 0 0 0", turn)).mesh), 12000.0, 1e-9);
  for (const std::string bad :
       {"1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 0", "1 0 0 0 1 0 0 0 one 0 0 0", "1 0 0 0 1 0 0 0 inf 0 0 0"})
    EXPECT_THAT(error(placed(bad, turn)),
                ::testing::StartsWith("a.3mf: 3D/3dmodel.model: transform of <item> is '1 0 0 0 1 0 0 0 "))
        << bad;
  EXPECT_THAT(error(placed("1 0 0 0 1 0 0 0 0 0 0 0", turn)), ::testing::EndsWith("', not invertible"));
}

TEST_F(ThreeMf, SupportsAreNoPartOfTheObject) {
  for (const std::string type : {"support", "solidsupport", "other"}) {
    const std::string support = object(2, cuboid(99, 99, 99), "type=\"" + type + "\"");
    EXPECT_EQ(extent(package(model(kBox + support, kItem + "<item objectid=\"2\"/>"))),
              (std::vector<double>{0, 0, 0, 10, 20, 30}))
        << type;
    EXPECT_EQ(error(package(model(support, "<item objectid=\"2\"/>"))), "a.3mf: has no triangles");
  }
  EXPECT_EQ(read(package(model(object(1, cuboid(1, 2, 3), "type=\"surface\""), kItem))).mesh.num_triangles(), 12);
  EXPECT_EQ(error(package(model(object(1, cuboid(1, 2, 3), "type=\"hull\""), kItem))),
            "a.3mf: 3D/3dmodel.model: type of <object> is 'hull', not model, solidsupport, support, surface or other");
}

TEST_F(ThreeMf, ShapesThatAreNotReadAreRefusedByName) {
  const auto refused = [&](const std::string& objects, const std::string& attributes = "") {
    return error(package(model(objects, kItem, attributes)));
  };
  std::string lattice = cuboid(1, 1, 1);
  lattice.insert(lattice.size() - 7,
                 "<b:beamlattice xmlns:b=\"http://schemas.microsoft.com/b\"><b:beams/></b:beamlattice>");
  EXPECT_EQ(
      refused(object(1, lattice)),
      "a.3mf: 3D/3dmodel.model: object 1 has <b:beamlattice> of http://schemas.microsoft.com/b, which is not read");
  EXPECT_EQ(refused(object(1, "<o:booleans xmlns:o=\"http://o\" objectid=\"2\"/>")),
            "a.3mf: 3D/3dmodel.model: object 1 has <o:booleans> of http://o, which is not read");
  EXPECT_EQ(refused(object(1, cuboid(1, 1, 1), "s:slicestackid=\"3\" s:meshresolution=\"lowres\"")),
            "a.3mf: 3D/3dmodel.model: object 1 is lowres by its s:meshresolution: it stands in for another shape");
  EXPECT_EQ(
      refused(kBox, "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" requiredextensions=\"s\""),
      "a.3mf: 3D/3dmodel.model: requires the extension 's' (…soft.com/3dmanufacturing/slice/2015/07), which is not "
      "read");
  EXPECT_EQ(refused(kBox, "requiredextensions=\"x\""),
            "a.3mf: 3D/3dmodel.model: requires the extension 'x', which is not read");
  EXPECT_EQ(refused(object(1, "")), "a.3mf: 3D/3dmodel.model: object 1 has neither a mesh nor components");
  // Only what is built must be readable.
  EXPECT_EQ(extent(package(model(object(5, lattice) + kBox, kItem))), (std::vector<double>{0, 0, 0, 10, 20, 30}));
}

TEST_F(ThreeMf, FullMeshesOfOtherExtensionsAreRead) {
  std::string grouped = cuboid(10, 20, 30);
  grouped.insert(grouped.size() - 7,
                 "<t:trianglesets xmlns:t=\"http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07\"/>");
  for (const std::string& box :
       {object(1, grouped),
        object(1, "<metadatagroup><metadata name=\"a\">b</metadata></metadatagroup>" + cuboid(10, 20, 30)),
        object(1, cuboid(10, 20, 30), "s:meshresolution=\"fullres\" pid=\"3\" p:UUID=\"9\"")})
    EXPECT_EQ(extent(package(model(box, kItem))), (std::vector<double>{0, 0, 0, 10, 20, 30}));
}

TEST_F(ThreeMf, ModifiersOfASlicerAreNamed) {
  const auto volume = [](const std::string& kind) {
    return "<volume firstid=\"0\"><metadata type=\"volume\" key=\"volume_type\" value=\"" + kind + "\"/></volume>";
  };
  const auto kinds = [&](const std::string& volumes) {
    return volumes_that_are_no_parts("<config><object id=\"1\">" + volumes + "</object></config>", "a");
  };
  EXPECT_EQ(kinds(volume("ModelPart") + volume("ModelPart")), "");
  EXPECT_EQ(kinds(volume("ModelPart") + volume("ParameterModifier")), "ParameterModifier");
  EXPECT_EQ(kinds(volume("NegativeVolume") + volume("SupportBlocker") + volume("NegativeVolume")),
            "NegativeVolume, SupportBlocker");
  EXPECT_EQ(volumes_that_are_no_parts("no XML", "a"), "");
  EXPECT_EQ(extent(package(model(kBox, kItem), {{"Metadata/Slic3r_PE_model.config", "no XML"}})),
            (std::vector<double>{0, 0, 0, 10, 20, 30}));
}

TEST_F(ThreeMf, XmlOfOtherEncodingsAndPrefixesIsRead) {
  const std::string text = model(kBox, kItem);
  std::string utf16 = "\xFF\xFE", prefixed;
  for (const char c : text.substr(text.find('\n') + 1)) (utf16 += c) += '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    prefixed += text[i];
    if (text[i] == '<' && text[i + 1] != '?' && text[i + 1] != '/') prefixed += "c:";
    if (text.substr(i, 2) == "</") prefixed += "/c:", ++i;
  }
  prefixed.replace(prefixed.find("xmlns="), 6, "xmlns:c=");
  for (const std::string& root : {utf16, prefixed, "\xEF\xBB\xBF" + text})
    EXPECT_EQ(extent(package(root)), (std::vector<double>{0, 0, 0, 10, 20, 30}));
  EXPECT_EQ(
      error(package("<model xmlns=\"http://another\"/>")),
      "a.3mf: 3D/3dmodel.model: its root element is <model> of http://another, not <model> of " + std::string(kCore));
}

TEST_F(ThreeMf, BrokenPackagesAreRefused) {
  const auto with_relationships = [&](const std::string& text) {
    NamedFiles files = package(model(kBox, kItem));
    files[1].second = text;
    return error(files);
  };
  EXPECT_EQ(with_relationships(relationships("/4D/other.model")),
            "a.3mf: _rels/.rels: names a root model, /4D/other.model, that is not there");
  EXPECT_THAT(with_relationships("hello"), ::testing::StartsWith("a.3mf: _rels/.rels: is not XML ("));
  EXPECT_THAT(with_relationships("<Relationships><"), ::testing::StartsWith("a.3mf: _rels/.rels: is not XML ("));
  EXPECT_EQ(with_relationships("<Relationships/>"), "a.3mf: _rels/.rels: names no root model");
  EXPECT_EQ(with_relationships(relationships("a.model\" TargetMode=\"External")),
            "a.3mf: _rels/.rels: the root model lies outside of the archive");
  EXPECT_EQ(error({{kRoot, model(kBox, kItem)}}), "a.3mf: is not a 3MF file (the archive has no _rels/.rels)");
  EXPECT_THAT(error(package("no model")), ::testing::StartsWith("a.3mf: 3D/3dmodel.model: is not XML ("));
  EXPECT_EQ(error(package(model(kBox, ""))),
            "a.3mf: 3D/3dmodel.model: its build has no items, so there is nothing to read");
  const std::string whole = zip_of(package(model(kBox, kItem)));
  for (const std::string& bytes :
       {std::string("PK"), std::string("no archive at all"), whole.substr(0, whole.size() / 2)})
    EXPECT_THAT(error_of_bytes(bytes), ::testing::StartsWith("a.3mf: is not a ZIP archive, or is damaged ("));
  EXPECT_EQ(error_of_bytes(""), "a.3mf: the file is empty");
}

TEST_F(ThreeMf, BrokenMeshesAreRefused) {
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string box = kBox;
    box.replace(box.find(from), from.size(), to);
    return error(package(model(box, kItem)));
  };
  const std::string place = "a.3mf: 3D/3dmodel.model: ";
  EXPECT_EQ(refused("x=\"10\"", "x=\"ten\""), place + "object 1: x of vertex 1 is 'ten', not a number");
  EXPECT_EQ(refused("x=\"10\"", "x=\"nan\""), place + "object 1: x of vertex 1 is 'nan', not a number");
  EXPECT_EQ(refused("x=\"10\"", ""), place + "object 1: x of vertex 1 is '', not a number");
  EXPECT_EQ(refused("v3=\"3\"", "v3=\"8\""), place + "object 1: triangle 1 names the vertex '8' of 8 (counted from 0)");
  EXPECT_EQ(refused("v3=\"3\"", "v3=\"-1\""),
            place + "object 1: triangle 1 names the vertex '-1' of 8 (counted from 0)");
  EXPECT_EQ(refused("id=\"1\"", "id=\"0\""), place + "id of <object> is '0', not a whole number from 1");
  EXPECT_EQ(error(package(model(kBox + kBox, kItem))), place + "has object 1 twice");
  EXPECT_EQ(error(package(model(object(1, cuboid(1, 1, 1) + cuboid(1, 1, 1)), kItem))),
            place + "object 1 has more than one mesh or list of components");
  EXPECT_EQ(error(package(model(kBox, "<item objectid=\"3\"/>"))), place + "has no object 3, which it names");
}

TEST_F(ThreeMf, SmallFilesThatAskForMuchAreRefused) {
  const auto twice = [](int id) {
    return fmt::format("<components><component objectid=\"{0}\"/><component objectid=\"{0}\"/></components>", id);
  };
  std::string doubled = kBox;
  for (int id = 2; id <= 40; ++id) doubled += object(id, twice(id - 1));
  EXPECT_EQ(error(package(model(doubled, "<item objectid=\"40\"/>"))), "a.3mf: places more than 1000000 objects");
  EXPECT_EQ(error(package(model(object(1, twice(2)) + object(2, twice(1)), kItem))),
            "a.3mf: 3D/3dmodel.model: object 2: components are nested more than 64 deep, or in a circle");
  std::string large = cuboid(1, 1, 1);
  for (int i = 0; i < 100; ++i) large.insert(large.find("</triangles>"), "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>");
  doubled = object(1, large);
  for (int id = 2; id <= 19; ++id) doubled += object(id, twice(id - 1));
  EXPECT_EQ(error(package(model(doubled, "<item objectid=\"19\"/>"))), "a.3mf: has more than 16000000 triangles");
}

}  // namespace threemf_read_test
}  // namespace tacipc
