// The press folder: what happened to the gel, frame by frame. The only place that knows its arrays. `press` writes all
// of them, `mpm` some, as any other simulator may.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "common/format/npy_field.h"
#include "common/sample/contact_state.h"
#include "common/sample/motion.h"
#include "common/stage/stage.h"

namespace tacipc {

enum class PressArray {
  positions,
  object_pose,
  time,
  phase,
  wrench,
  contact_force,
  front_vertices,
  traction,
  contact_state,
  first_slip,
  markers,
  marker_displacement,
  object_twist,
  holder_pose
};

/// Symbols of shapes.
inline constexpr std::string_view kFrames = "frames", kVertices = "#V", kFrontVertices = "#V_front", kMarkers = "#M";
/// Cells of traction.npy.
inline constexpr int kTractionRows = 24, kTractionColumns = 32;

/// Every array, in the order of the enum: the table that docs/files.md shows.
std::span<const NpyField> press_fields();
const NpyField& field_of(PressArray array);

/// Beside the arrays: row, column, triangle and weights of each marker, as `markers_csv` writes them.
inline constexpr const char* kMarkersCsv = "markers.csv";

/// The two parts of a contact force (N) or of a traction (Pa), one row per vertex or cell.
struct ContactParts {
  Positions normal, friction;
};

/// Velocity of the object's centre of mass and angular velocity, along the axes of S.
struct Twist {
  Vector3 velocity_m_s, spin_rad_s;
};

/// Of every marker, m.
struct MarkerDisplacement {
  Positions since_rest, since_press;
};

/// Reads a press folder, of each array only what is asked for. Every reader throws DataError if the file is not there,
/// its shape is not the declared one or does not fit what is known of the folder, a number that has to be finite is
/// not, a code has no meaning, or the file is not the one that press.yaml vouches for by its hash. Not for several
/// threads at once.
class PressFolder {
 public:
  /// `known`: what symbols of shapes must stand for, where the caller knows it from elsewhere (the gel, the record).
  explicit PressFolder(std::filesystem::path folder, Extents known = {});
  /// \throw DataError if it has no press.yaml, so the press did not finish
  static PressFolder finished(std::filesystem::path folder, Extents known = {});

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path path(PressArray array) const { return folder_ / field_of(array).file; }
  bool has(PressArray array) const;
  /// Checks shapes before long work: every one of these must be there. Reads no values.
  void require(std::initializer_list<PressArray> arrays) const;
  /// What a symbol of this array's shape stands for.
  std::size_t extent(PressArray array, std::string_view symbol) const;
  /// \throw DataError if front_vertices.npy lists others than these
  void require_front(const std::vector<int>& vertices) const;

  std::vector<double> times() const;                     // s
  std::vector<PhaseKind> phases() const;                 // per frame
  std::vector<Matrix4> poses() const;                    // gel_from_object, m, per frame
  std::vector<Matrix4> holder_poses() const;             // the same on a rigid mount
  std::vector<Wrench> wrenches() const;                  // on the gel, about the origin of S, per frame
  std::vector<Twist> twists() const;                     // of the object, per frame
  std::vector<int> front_vertices() const;               // rows of positions; \throw DataError if one is none of these
  std::vector<double> first_slips() const;               // s, +∞ where a front vertex never slips
  Positions positions(std::size_t frame) const;          // #V × 3, m
  ContactParts contact_forces(std::size_t frame) const;  // #V_front rows, N
  std::vector<ContactState> contact_states(std::size_t frame) const;  // #V_front
  ContactParts tractions(std::size_t frame) const;                    // kTractionRows · kTractionColumns rows, Pa
  Positions markers(std::size_t frame) const;                         // #M × 3, m
  MarkerDisplacement marker_displacements(std::size_t frame) const;   // #M rows

 private:
  NpyFrames& open(PressArray array) const;
  void refuse_no_frames(PressArray array) const;
  void refuse_changed(PressArray array) const;
  std::vector<double> whole(PressArray array) const;
  std::vector<Matrix4> poses_of(PressArray array) const;
  std::vector<double> frame_of(PressArray array, std::size_t frame) const;

  std::filesystem::path folder_;
  mutable Extents known_;                         // grows with every array that is looked at
  mutable std::map<PressArray, NpyFrames> open_;  // files that are read frame by frame
  std::map<std::string, std::string> vouched_;    // hashes of the record, as far as there is one
  mutable std::set<PressArray> unchanged_;        // that were compared with them
};

/// Writes arrays of a press folder, as outputs of a stage.
class PressWriter {
 public:
  /// \param folder below --out
  PressWriter(Stage& stage, Extents extents, std::filesystem::path folder = {})
      : stage_(stage), extents_(std::move(extents)), folder_(std::move(folder)) {}

  void write(PressArray array, const std::vector<double>& values) const;
  /// `part` gives what the reader of this array returns, for each of the frames (or their one entry of it).
  template <typename Frames, typename Part>
  void write(PressArray array, const Frames& frames, Part&& part) const {
    std::vector<double> values;
    for (const auto& frame : frames) append(values, part(frame));
    write(array, values);
  }

 private:
  static void append(std::vector<double>& all, double value) { all.push_back(value); }
  static void append(std::vector<double>& all, PhaseKind phase) { all.push_back(static_cast<double>(phase)); }
  static void append(std::vector<double>& all, const std::vector<double>& values);
  static void append(std::vector<double>& all, const std::vector<ContactState>& states);
  static void append(std::vector<double>& all, const Matrix4& pose);
  static void append(std::vector<double>& all, const Positions& rows);
  static void append(std::vector<double>& all, const ContactParts& parts);
  static void append(std::vector<double>& all, const Wrench& wrench);
  static void append(std::vector<double>& all, const Twist& twist);

  Stage& stage_;
  Extents extents_;
  std::filesystem::path folder_;
};

}  // namespace tacipc
