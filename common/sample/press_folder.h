// The press folder: what happened to the gel, frame by frame. The only place that knows its arrays. `press` writes all
// of them, `mpm` some, as any other simulator may.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "common/base/symmetric_rows.h"
#include "common/base/types.h"
#include "common/sample/array_folder.h"
#include "common/sample/contact_state.h"
#include "common/sample/motion.h"

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
  holder_pose,
  stress,
  front_pressure,
  front_shear
};

/// Symbols of shapes.
inline constexpr std::string_view kVertices = "#V", kFrontVertices = "#V_front", kMarkers = "#M", kTets = "#T";
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

inline void append_numbers(std::vector<double>& all, const ContactParts& parts) {
  for (Eigen::Index i = 0; i < parts.normal.rows(); ++i)
    append_numbers(all, parts.normal.row(i)), append_numbers(all, parts.friction.row(i));
}

/// Force on the gel per deformed area at each front vertex, Pa: t = −p n + s with the outward normal n.
struct FrontTraction {
  Eigen::VectorXd pressure;  // p, > 0 where something pushes
  Positions shear;           // s, along the front
};

/// Of every marker, m.
struct MarkerDisplacement {
  Positions since_rest, since_press;
};

/// Reads a press folder as ArrayFolder does. Readers also throw DataError if a code has no meaning.
class PressFolder {
 public:
  explicit PressFolder(std::filesystem::path folder, Extents known = {})
      : PressFolder(ArrayFolder(std::move(folder), "press", std::move(known))) {}
  static PressFolder finished(std::filesystem::path folder, Extents known = {}) {
    return PressFolder(ArrayFolder::finished(std::move(folder), "press", std::move(known)));
  }

  const std::filesystem::path& folder() const { return arrays_.folder(); }
  std::filesystem::path path(PressArray array) const { return arrays_.path(field_of(array)); }
  bool has(PressArray array) const { return arrays_.has(field_of(array)); }
  /// Checks shapes before long work: every one of these must be there. Reads no values.
  void require(std::initializer_list<PressArray> arrays) const;
  /// Length that a symbol of this array's shape stands for.
  std::size_t extent(PressArray array, std::string_view symbol) const {
    return arrays_.extent(field_of(array), symbol);
  }
  /// \throw DataError if front_vertices.npy lists others than these
  void require_front(const std::vector<int>& vertices) const;

  std::vector<double> times() const;             // s
  std::vector<PhaseKind> phases() const;         // per frame
  std::vector<Matrix4> poses() const;            // gel_from_object, m, per frame
  std::vector<Matrix4> holder_poses() const;     // the same on a rigid mount
  std::vector<Wrench> wrenches() const;          // on the gel, about the origin of S, per frame
  std::vector<Twist> twists() const;             // of the object's centre of mass, along the axes of S, per frame
  std::vector<int> front_vertices() const;       // rows of positions; \throw DataError if one is none of these
  std::vector<double> first_slips() const;       // s, +∞ where a front vertex never slips
  Positions positions(std::size_t frame) const;  // #V × 3, m
  ContactParts contact_forces(std::size_t frame) const;               // #V_front rows, N
  std::vector<ContactState> contact_states(std::size_t frame) const;  // #V_front
  ContactParts tractions(std::size_t frame) const;                    // kTractionRows · kTractionColumns rows, Pa
  Positions markers(std::size_t frame) const;                         // #M × 3, m
  MarkerDisplacement marker_displacements(std::size_t frame) const;   // #M rows
  SymmetricRows stresses(std::size_t frame) const;                    // Cauchy stress, #T rows, Pa
  FrontTraction front_by_contact(std::size_t frame) const;            // #V_front rows
  FrontTraction front_by_stress(std::size_t frame) const;             // #V_front rows

 private:
  FrontTraction front_of(std::size_t frame, Eigen::Index which) const;
  explicit PressFolder(ArrayFolder arrays) : arrays_(std::move(arrays)) {}
  std::vector<double> frame_of(PressArray array, std::size_t frame) const {
    return arrays_.frame_of(field_of(array), frame);
  }

  ArrayFolder arrays_;
};

}  // namespace tacipc
