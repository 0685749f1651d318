#include "stages/gel/tetmesh/import.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/base/error.h"
#include "common/base/files.h"
#include "stages/gel/tetmesh/tetmesh_config.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "tests/shared_data.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace import_test {

ImportConfig import_preset(const std::string& name) {
  return std::get<ImportConfig>(read_config<TetmeshConfig>(config_path("gels/" + name + ".yaml")).way);
}

/// Gmsh 2.2 ASCII with nodes and tets alone.
std::string msh22(const Positions& positions, const Tetrahedra& tets) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", positions.rows());
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    text += fmt::format("{} {} {} {}\n", v + 1, positions(v, 0), positions(v, 1), positions(v, 2));
  text += fmt::format("$EndNodes\n$Elements\n{}\n", tets.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    text += fmt::format("{} 4 0 {} {} {} {}\n", t + 1, tets(t, 0) + 1, tets(t, 1) + 1, tets(t, 2) + 1, tets(t, 3) + 1);
  return text + "$EndElements\n";
}

/// The identity in metres, with the rules of import_paper.yaml.
ImportConfig as_it_stands() {
  ImportConfig config = import_preset("import_paper");
  config.rotation = Matrix3::Identity();
  return config;
}

class ImportTest : public ::testing::Test {
 protected:
  std::string fault(const std::filesystem::path& path, const ImportConfig& config) const {
    return message_of<DataError>([&] { import_gel(path, config, gel_); });
  }
  void expect_same(const TetMesh& got) const {
    EXPECT_EQ(got.positions, mesh_.positions);
    EXPECT_EQ(got.tets, mesh_.tets);
    for (const BoundaryTag tag : {BoundaryTag::front, BoundaryTag::side, BoundaryTag::glued})
      EXPECT_EQ(got.vertices(tag), mesh_.vertices(tag));
  }

  ScratchFolder scratch_;
  GelShape gel_ = mctac_gel();
  TetMesh mesh_ = generate_gel(gel_, preset("tiny"));
};

TEST_F(ImportTest, TakesBackWhatWasWrittenInEitherFormat) {
  write_tet_mesh(scratch_ / "a.msh", mesh_);
  expect_same(import_gel(scratch_ / "a.msh", as_it_stands(), gel_).mesh);
  expect_same(import_gel(scratch_.file("b.msh", msh22(mesh_.positions, mesh_.tets)), as_it_stands(), gel_).mesh);
}

TEST_F(ImportTest, HalfTurnAndMillimetresKeepOrderAndBits) {
  Positions turned = mesh_.positions;
  turned.col(1) *= -1.0;
  turned.col(2) *= -1.0;
  const auto path = scratch_.file("turned.msh", msh22(turned, mesh_.tets));
  const ImportedGel back = import_gel(path, import_preset("import_paper"), gel_);
  EXPECT_FALSE(back.flipped);
  expect_same(back.mesh);
  ImportConfig millimetres = import_preset("import_paper");
  millimetres.unit_m = 1e-3;
  const Positions in_mm = turned * 1e3;
  const ImportedGel scaled = import_gel(scratch_.file("mm.msh", msh22(in_mm, mesh_.tets)), millimetres, gel_);
  EXPECT_LT((scaled.mesh.positions - mesh_.positions).cwiseAbs().maxCoeff(), 1e-17);
}

TEST_F(ImportTest, GluedFaceByAngle) {
  ImportConfig config = as_it_stands();
  config.glued_plane_z_m.reset();
  config.glued_max_angle_deg = 10.0;
  expect_same(import_gel(scratch_.file("a.msh", msh22(mesh_.positions, mesh_.tets)), config, gel_).mesh);
}

TEST_F(ImportTest, TurnsAMeshThatIsNegativeThroughout) {
  Tetrahedra negative = mesh_.tets;
  negative.col(2).swap(negative.col(3));
  const ImportedGel gel = import_gel(scratch_.file("n.msh", msh22(mesh_.positions, negative)), as_it_stands(), gel_);
  EXPECT_TRUE(gel.flipped);
  EXPECT_EQ(gel.mesh.positions, mesh_.positions);
  EXPECT_NEAR(volume_of(gel.mesh), volume_of(mesh_), 1e-20);
}

TEST_F(ImportTest, RefusesMixedAndFlatTets) {
  Tetrahedra mixed = mesh_.tets;
  std::swap(mixed(5, 0), mixed(5, 1));
  std::swap(mixed(9, 0), mixed(9, 1));
  auto path = scratch_.file("m.msh", msh22(mesh_.positions, mixed));
  EXPECT_EQ(fault(path, as_it_stands()), fmt::format("{}: 2 of {} tets are negatively oriented, the first is tet 5",
                                                     path.string(), mesh_.num_tets()));
  Positions flat = mesh_.positions;
  flat.col(2).setZero();
  path = scratch_.file("f.msh", msh22(flat, mesh_.tets));
  EXPECT_EQ(fault(path, as_it_stands()), path.string() + ": tet 0 has no volume");
}

TEST_F(ImportTest, RefusesAnotherSensorsGel) {
  const auto path = scratch_.file("a.msh", msh22(mesh_.positions, mesh_.tets));
  ImportConfig config = as_it_stands();
  config.unit_m = 1e-3;
  EXPECT_EQ(
      fault(path, config),
      path.string() +
          ": its outline or depth differs from the sensor's gel by 15 mm, more than 0.0001 mm; after the transform it "
          "fills x -0.01496 … 0.015, y -0.01499 … 0.01499, z -0.002 … 0 mm, the gel 30 × 30 mm and -2 … 0 mm");
  config = as_it_stands();
  config.translation_m = {1e-3, 0, 0};
  EXPECT_NE(fault(path, config).find("differs from the sensor's gel by 1 mm"), std::string::npos)
      << fault(path, config);
}

TEST_F(ImportTest, RefusesCutCorners) {
  GelShape box;
  box.outline = GelShape::Outline::rectangle;
  box.width_m = box.height_m = 0.03;
  box.thickness_m = 0.002;
  const auto path = scratch_.file("a.msh", msh22(mesh_.positions, mesh_.tets));
  const std::string message = message_of<DataError>([&] { import_gel(path, as_it_stands(), box); });
  EXPECT_NE(message.find(" mm off the sensor's outline, more than 0.0001 mm"), std::string::npos) << message;
}

TEST_F(ImportTest, RefusesAGluedRuleThatFindsNothing) {
  const auto path = scratch_.file("a.msh", msh22(mesh_.positions, mesh_.tets));
  ImportConfig config = as_it_stands();
  config.glued_plane_z_m = -1e-3;
  EXPECT_EQ(fault(path, config), path.string() + ": no boundary triangle belongs to the glued face");
}

TEST_F(ImportTest, RefusesATruncatedFileAndOneWithoutTets) {
  const std::string whole = msh22(mesh_.positions, mesh_.tets);
  for (const std::size_t part : {2, 3, 5}) {
    const auto path = scratch_.file("cut.msh", whole.substr(0, whole.size() / part));
    EXPECT_EQ(fault(path, as_it_stands()).find(path.string() + ":"), 0u) << "cut to 1 / " << part;
  }
  const auto path = scratch_.file("empty.msh", msh22(mesh_.positions, Tetrahedra(0, 4)));
  EXPECT_EQ(fault(path, as_it_stands()).find(path.string() + ":"), 0u) << fault(path, as_it_stands());
}

TEST(ImportConfig, FaultsNameTheirPlace) {
  const std::string text =
      "kind: import\nunit: m\ntransform: {scale: [1, 1, -1], rotation_axis: [0, 0, 0], rotation_deg: 90, "
      "translation_mm: [0, 0, 0]}\nglued: {plane_z_mm: -2, tolerance_mm: 0, max_angle_deg: 5}\n"
      "front: {max_angle_deg: 45}\nlimits: {fit_tolerance_mm: 0, min_dihedral_deg: 1}\n";
  EXPECT_EQ(message_of<ConfigError>([&] { config_from_text<TetmeshConfig>(text, "i.yaml"); }),
            "i.yaml:3:27: transform.scale[2]: -1 is outside (0, inf)\n"
            "i.yaml:3:47: transform.rotation_axis: must not be zero\n"
            "i.yaml:4:21: glued.plane_z_mm: give either plane_z_mm (with tolerance_mm) or max_angle_deg");
}

TEST(ImportPaper, GelKeepsItsNodesAndTheirFixedOnes) {
  TACIPC_SHARED_DATA(folder, "data/tacipc_release/gel");
  const auto path = folder / "gelslim-gel-l_0.1.msh";
  const ImportedGel gel = import_gel(path, import_preset("import_paper"), mctac_gel());
  EXPECT_FALSE(gel.flipped);
  EXPECT_EQ(gel.mesh.num_vertices(), 23661);
  EXPECT_EQ(gel.mesh.num_tets(), 104675);
  EXPECT_EQ(gel.mesh.vertices(BoundaryTag::front).size(), 10966u);
  const Positions in_file = read_msh(path).positions;
  EXPECT_EQ(gel.mesh.positions.col(0), in_file.col(0));
  EXPECT_EQ(gel.mesh.positions.col(2), -in_file.col(2));
  // The file beside it lists 0 or 1 per node: fixed or not.
  std::vector<int> fixed;
  int node = 0;
  for (const char c : read_file(folder / "isBC_gelslim-gel-l_0.1.json")) {
    if (c == '1') fixed.push_back(node);
    node += c == '0' || c == '1';
  }
  EXPECT_EQ(node, 23661);
  EXPECT_EQ(gel.mesh.vertices(BoundaryTag::glued), fixed);
  EXPECT_EQ(fixed.size(), 842u);
}

TEST(ImportPaper, ThreeMillimetreGelOfTheFrictionTests) {
  TACIPC_SHARED_DATA(path, "data/tacipc_release/gel/gelslim-gel-l_0.1.msh");
  GelShape thick = mctac_gel();
  thick.thickness_m = 3e-3;
  const ImportedGel gel = import_gel(path, import_preset("import_paper_3mm"), thick);
  EXPECT_EQ(gel.mesh.vertices(BoundaryTag::glued).size(), 842u);
  EXPECT_NEAR(volume_of(gel.mesh) / analytic_volume(thick), 1.0, 0.01);
}

TEST(ImportReference, GelsOfTheReferenceScenes) {
  for (const auto& [file, vertices, tets] :
       {std::tuple{"reference/gel24k.msh", 23512, 104783}, std::tuple{"reference/gel3k.msh", 3113, 11727}}) {
    TACIPC_SHARED_DATA(path, file);
    const ImportedGel gel = import_gel(path, import_preset("import_reference"), mctac_gel());
    EXPECT_EQ(gel.mesh.num_vertices(), vertices);
    EXPECT_EQ(gel.mesh.num_tets(), tets);
    EXPECT_FALSE(gel.flipped);
  }
}

}  // namespace import_test
}  // namespace tacipc
