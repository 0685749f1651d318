// The press folder: state of the gel in every frame. The only unit that declares its arrays. `press` writes all of
// them; `mpm`, like any other simulator, may write some.
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

/// Arrays of a press folder; field_of() gives file, shape, unit and meaning.
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

/// Symbols in array shapes.
inline constexpr std::string_view kVertices = "#V", kFrontVertices = "#V_front", kMarkers = "#M", kTets = "#T";
/// Number of cells of traction.npy.
inline constexpr int kTractionRows = 24, kTractionColumns = 32;

/// Returns the declarations of all arrays in the order of the enum: the table of docs/files.md.
std::span<const NpyField> press_fields();
/// Returns the declaration of an array.
const NpyField& field_of(PressArray array);

/// File next to the arrays: row, column, triangle and weights of each marker, as markers_csv() writes them.
inline constexpr const char* kMarkersCsv = "markers.csv";

/// Normal and friction part of a contact force (N) or traction (Pa), one row per vertex or cell.
struct ContactParts {
  Positions normal, friction;
};

inline void append_numbers(std::vector<double>& all, const ContactParts& parts) {
  for (Eigen::Index i = 0; i < parts.normal.rows(); ++i)
    append_numbers(all, parts.normal.row(i)), append_numbers(all, parts.friction.row(i));
}

/// Force on the gel per deformed area at each front vertex, Pa: t = −p n + s, with the outward normal n.
struct FrontTraction {
  Eigen::VectorXd pressure;  // p, positive in compression
  Positions shear;           // s, tangential to the front
};

/// Displacement of every marker, m.
struct MarkerDisplacement {
  // since frame 0, and since the end of the first press phase
  Positions since_rest, since_press;
};

/// Reads a press folder as ArrayFolder does.
/// \throw DataError also if a code has no meaning
class PressFolder {
 public:
  /// Opens a folder, finished or not.
  explicit PressFolder(std::filesystem::path folder, Extents known = {})
      : PressFolder(ArrayFolder(std::move(folder), "press", std::move(known))) {}
  /// Opens the folder of a finished run.
  /// \throw DataError if the run did not finish
  static PressFolder finished(std::filesystem::path folder, Extents known = {}) {
    return PressFolder(ArrayFolder::finished(std::move(folder), "press", std::move(known)));
  }

  const std::filesystem::path& folder() const { return arrays_.folder(); }
  /// Returns the path of an array's file.
  std::filesystem::path path(PressArray array) const { return arrays_.path(field_of(array)); }
  /// Returns whether the array's file exists.
  bool has(PressArray array) const { return arrays_.has(field_of(array)); }
  /// Checks that these arrays exist with valid shapes, before long work starts. Reads no values.
  void require(std::initializer_list<PressArray> arrays) const;
  /// Returns the extent of a symbol in this array's shape.
  std::size_t extent(PressArray array, std::string_view symbol) const {
    return arrays_.extent(field_of(array), symbol);
  }
  /// Checks the front's vertices.
  /// \throw DataError if front_vertices.npy lists other vertices
  void require_front(const std::vector<int>& vertices) const;

  std::vector<double> times() const;             // s
  std::vector<PhaseKind> phases() const;         // per frame
  std::vector<Matrix4> poses() const;            // gel_from_object, m, per frame
  std::vector<Matrix4> holder_poses() const;     // poses if the mount were rigid, gel_from_object, m, per frame
  std::vector<Wrench> wrenches() const;          // total wrench on the gel about the origin of S, per frame
  std::vector<Twist> twists() const;             // twist at the object's centre of mass, axes of S, per frame
  std::vector<int> front_vertices() const;       // rows of positions; \throw DataError if an index is out of range
  std::vector<double> first_slips() const;       // s, one per front vertex; +∞ if it never slips
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
