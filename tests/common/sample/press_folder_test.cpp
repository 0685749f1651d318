#include "common/sample/press_folder.h"

#include <gmock/gmock.h>

#include <limits>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace press_folder_test {

using ::testing::ElementsAre;

/// Two frames of three gel vertices, of which two are on the front, and one marker.
struct Instant {
  Positions positions;
  Matrix4 pose;
  double time_s;
  PhaseKind phase;
  Wrench wrench;
  ContactParts forces;
  std::vector<ContactState> states;
};

const std::vector<Instant> kInstants{
    {.positions = Positions{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}},
     .pose = Matrix4::Identity(),
     .time_s = 0.0,
     .phase = PhaseKind::reference,
     .wrench = {Vector3::Zero(), Vector3::Zero()},
     .forces = {Positions::Zero(2, 3), Positions::Zero(2, 3)},
     .states = {ContactState::none, ContactState::none}},
    {.positions = Positions{{1, 2, 2}, {4, 5, 5}, {7, 8, 8}},
     .pose = Matrix4{{0, -1, 0, 10}, {1, 0, 0, 20}, {0, 0, 1, 30}, {0, 0, 0, 1}},
     .time_s = 0.25,
     .phase = PhaseKind::load,
     .wrench = {{1, 2, 3}, {4, 5, 6}},
     .forces = {Positions{{1, 2, 3}, {4, 5, 6}}, Positions{{-1, -2, -3}, {-4, -5, -6}}},
     .states = {ContactState::slip, ContactState::stick}}};
const double kNever = std::numeric_limits<double>::infinity();

class PressFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<std::string> words{"press", "--out", folder_.string(), "--log-level", "off"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    const StageSpec spec{.name = "press", .summary = "Writes a folder.", .inputs = {}};
    ASSERT_EQ(run_stage(spec, static_cast<int>(argv.size()), argv.data(), write), 0);
  }

  static void write(Stage& stage) {
    using enum PressArray;
    const ArrayWriter writer(stage, {{kFrames, 2}, {kVertices, 3}, {kFrontVertices, 2}, {kMarkers, 1}, {kTets, 1}});
    writer.write(positions, kInstants, [](const Instant& i) { return i.positions; });
    writer.write(object_pose, kInstants, [](const Instant& i) { return i.pose; });
    writer.write(time, kInstants, [](const Instant& i) { return i.time_s; });
    writer.write(phase, kInstants, [](const Instant& i) { return i.phase; });
    writer.write(wrench, kInstants, [](const Instant& i) { return i.wrench; });
    writer.write(contact_force, kInstants, [](const Instant& i) { return i.forces; });
    writer.write(front_vertices, {0, 2});
    std::vector<double> counted(2 * 24 * 32 * 6);
    for (std::size_t i = 0; i < counted.size(); ++i) counted[i] = static_cast<double>(i);
    writer.write(traction, counted);
    writer.write(contact_state, kInstants, [](const Instant& i) { return i.states; });
    writer.write(first_slip, {kNever, 0.25});
    writer.write(markers, {1, 2, 3, 4, 5, 6});
    writer.write(marker_displacement, {0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6});
    writer.write(object_twist, {0, 0, 0, 0, 0, 0, 7, 8, 9, 10, 11, 12});
    writer.write(holder_pose, kInstants, [](const Instant& i) { return Matrix4(2.0 * i.pose); });
    writer.write(stress, {0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6});
    writer.write(front_pressure, {0, 0, 0, 0, 1, 2, 3, 4});
    std::vector<double> shears(12, 0.0);
    for (int i = 1; i <= 12; ++i) shears.push_back(i);
    writer.write(front_shear, shears);
  }

  std::string refused(const std::function<void(const PressFolder&)>& read) const {
    std::string said = message_of<DataError>([&] { read(PressFolder(folder_)); });
    const std::string prefix = folder_.string() + "/";
    return said.starts_with(prefix) ? said.substr(prefix.size()) : said;
  }

  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_ / "press";
};

TEST_F(PressFolderTest, EveryDeclaredArrayIsInTheFile) {
  const std::vector<std::pair<std::string, std::vector<std::size_t>>> written{{"positions.npy", {2, 3, 3}},
                                                                              {"object_pose.npy", {2, 4, 4}},
                                                                              {"time.npy", {2}},
                                                                              {"phase.npy", {2}},
                                                                              {"wrench.npy", {2, 6}},
                                                                              {"contact_force.npy", {2, 2, 2, 3}},
                                                                              {"front_vertices.npy", {2}},
                                                                              {"traction.npy", {2, 24, 32, 2, 3}},
                                                                              {"contact_state.npy", {2, 2}},
                                                                              {"first_slip.npy", {2}},
                                                                              {"markers.npy", {2, 1, 3}},
                                                                              {"marker_displacement.npy", {2, 1, 2, 3}},
                                                                              {"object_twist.npy", {2, 6}},
                                                                              {"holder_pose.npy", {2, 4, 4}},
                                                                              {"stress.npy", {2, 1, 6}},
                                                                              {"front_pressure.npy", {2, 2, 2}},
                                                                              {"front_shear.npy", {2, 2, 2, 3}}};
  ASSERT_EQ(press_fields().size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(press_fields()[i].file, written[i].first);
    EXPECT_EQ(read_npy(folder_ / written[i].first).shape, written[i].second) << written[i].first;
  }
}

TEST_F(PressFolderTest, ValuesLieWhereOtherProgramsLookForThem) {
  EXPECT_THAT(read_npy(folder_ / "phase.npy").data, ElementsAre(0, 9));
  EXPECT_THAT(read_npy(folder_ / "contact_state.npy").data, ElementsAre(0, 0, 2, 1));
  EXPECT_EQ(read_npy(folder_ / "object_pose.npy").data[16 + 3], 10);
  EXPECT_THAT(read_npy(folder_ / "wrench.npy").data, ElementsAre(0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6));
  const std::vector<double> forces = read_npy(folder_ / "contact_force.npy").data;
  EXPECT_THAT(std::vector<double>(forces.begin() + 12, forces.end()),
              ElementsAre(1, 2, 3, -1, -2, -3, 4, 5, 6, -4, -5, -6));
  EXPECT_NE(read_file(folder_ / "front_vertices.npy").find("'<i4'"), std::string::npos);
  EXPECT_NE(read_file(folder_ / "phase.npy").find("'|u1'"), std::string::npos);
}

TEST_F(PressFolderTest, WhatIsWrittenReadsBack) {
  const PressFolder press = PressFolder::finished(folder_);
  EXPECT_EQ(press.extent(PressArray::markers, kMarkers), 1u);
  EXPECT_THAT(press.times(), ElementsAre(0.0, 0.25));
  EXPECT_THAT(press.phases(), ElementsAre(PhaseKind::reference, PhaseKind::load));
  EXPECT_EQ(press.poses()[1], kInstants[1].pose);
  EXPECT_EQ(press.holder_poses()[1], Matrix4(2.0 * kInstants[1].pose));
  EXPECT_EQ(press.wrenches()[1].torque_n_m, kInstants[1].wrench.torque_n_m);
  EXPECT_THAT(press.front_vertices(), ElementsAre(0, 2));
  EXPECT_THAT(press.first_slips(), ElementsAre(kNever, 0.25));
  EXPECT_EQ(press.positions(1), kInstants[1].positions);
  EXPECT_EQ(press.contact_forces(1).normal, kInstants[1].forces.normal);
  EXPECT_EQ(press.contact_forces(1).friction, kInstants[1].forces.friction);
  EXPECT_EQ(press.contact_states(1), kInstants[1].states);
  EXPECT_EQ(press.tractions(1).friction.rows(), kTractionRows * kTractionColumns);
  EXPECT_EQ(press.tractions(1).friction(1, 2), 24 * 32 * 6 + 11);
  EXPECT_EQ(press.markers(1), (Positions{{4, 5, 6}}));
  EXPECT_EQ(press.marker_displacements(1).since_rest, (Positions{{1, 2, 3}}));
  EXPECT_EQ(press.marker_displacements(1).since_press, (Positions{{4, 5, 6}}));
  EXPECT_EQ(press.twists()[1].velocity_m_s, Vector3(7, 8, 9));
  EXPECT_EQ(press.twists()[1].spin_rad_s, Vector3(10, 11, 12));
  EXPECT_EQ(press.stresses(1), (SymmetricRows{{1, 2, 3, 4, 5, 6}}));
  EXPECT_EQ(press.front_by_contact(1).pressure, Eigen::Vector2d(1, 3));
  EXPECT_EQ(press.front_by_stress(1).pressure, Eigen::Vector2d(2, 4));
  EXPECT_EQ(press.front_by_contact(1).shear, (Positions{{1, 2, 3}, {7, 8, 9}}));
  EXPECT_EQ(press.front_by_stress(1).shear, (Positions{{4, 5, 6}, {10, 11, 12}}));
}

TEST_F(PressFolderTest, AFileOfWhichOneBitIsNotAsRecordedIsRefused) {
  const auto read_all = [](const PressFolder& press) {
    for (std::size_t frame = 0; frame < 2; ++frame) {
      press.positions(frame);
      press.contact_forces(frame);
      press.contact_states(frame);
      press.tractions(frame);
      press.markers(frame);
      press.marker_displacements(frame);
      press.stresses(frame);
      press.front_by_contact(frame);
    }
    press.times(), press.phases(), press.poses(), press.holder_poses(), press.wrenches(), press.twists(),
        press.front_vertices(), press.first_slips();
  };
  EXPECT_NO_THROW(read_all(PressFolder::finished(folder_)));
  for (const NpyField& field : press_fields()) {
    const std::string sound = read_file(folder_ / field.file);
    std::string spoiled = sound;
    spoiled.back() = static_cast<char>(spoiled.back() ^ 1);
    write_file(folder_ / field.file, spoiled);
    EXPECT_EQ(refused(read_all), std::string(field.file) + ": has changed since press.yaml was written beside it");
    write_file(folder_ / field.file, sound);
  }
}

TEST_F(PressFolderTest, FilesThatDoNotFitEachOtherAreRefused) {
  std::filesystem::remove(folder_ / "press.yaml");  // of another simulator, which vouches for nothing
  const std::vector<double> zeros(100, 0.0);
  write_npy(folder_ / "contact_state.npy", {3, 2}, zeros.data());
  EXPECT_EQ(refused([](const PressFolder& press) {
              press.times();
              press.contact_states(0);
            }),
            "contact_state.npy: has the shape (3, 2), expected (2, #V_front)");
  EXPECT_EQ(message_of<DataError>([&] {
              PressFolder(folder_, {{kVertices, 4}}).positions(0);
            }),
            (folder_ / "positions.npy").string() + ": has the shape (2, 3, 3), expected (frames, 4, 3)");
  write_npy(folder_ / "time.npy", {0}, zeros.data());
  EXPECT_EQ(refused([](const PressFolder& press) { press.times(); }), "time.npy: has no frames");
  EXPECT_EQ(refused([](const PressFolder& press) { press.positions(2); }),
            "positions.npy: has no frame 2, but 2 frames");
}

TEST_F(PressFolderTest, ValuesWithoutMeaningAreRefused) {
  std::filesystem::remove(folder_ / "press.yaml");
  const std::vector<double> nan(100, std::numeric_limits<double>::quiet_NaN());
  write_npy(folder_ / "markers.npy", {2, 1, 3}, nan.data());
  EXPECT_EQ(refused([](const PressFolder& press) { press.markers(1); }),
            "markers.npy: frame 1: the value at [0, 0] is not finite");
  const std::uint8_t states[]{0, 1, 2, 3};
  write_npy(folder_ / "contact_state.npy", {2, 2}, states);
  EXPECT_EQ(refused([](const PressFolder& press) { press.contact_states(1); }),
            "contact_state.npy: value 3 is 3, which is not one of 0 no contact, 1 stick, 2 slip");
  const std::int32_t rows[]{0, 3};
  write_npy(folder_ / "front_vertices.npy", {2}, rows);
  EXPECT_EQ(refused([](const PressFolder& press) { press.front_vertices(); }),
            "front_vertices.npy: 3 is not a row of positions.npy");
}

TEST_F(PressFolderTest, OnlyAFinishedPressHasARecord) {
  std::filesystem::remove(folder_ / "press.yaml");
  EXPECT_EQ(message_of<DataError>([&] { PressFolder::finished(folder_); }),
            folder_.string() + ": has no press.yaml, so the press did not finish");
  EXPECT_TRUE(PressFolder(folder_).has(PressArray::wrench));
  std::filesystem::remove(folder_ / "wrench.npy");
  EXPECT_FALSE(PressFolder(folder_).has(PressArray::wrench));
}

TEST_F(PressFolderTest, TheFrontMustBeTheGels) {
  EXPECT_EQ(refused([](const PressFolder& press) { press.require_front({0, 2}); }), "");
  EXPECT_EQ(refused([](const PressFolder& press) {
              press.require_front({0, 1});
            }),
            "front_vertices.npy: does not list the front of the gel");
}

}  // namespace press_folder_test
}  // namespace tacipc
