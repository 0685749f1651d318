#include "verification/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "stages/gel/press/measure/front_surface.h"
#include "verification/bonded_layer.h"
#include "verification/closed_forms.h"
#include "verification/shared_files.h"

namespace tacipc::verify {
namespace {

using Kind = ObjectShape::Kind;

double gel_thickness_m(const TetMesh& gel) { return gel.positions.col(2).maxCoeff() - gel.positions.col(2).minCoeff(); }

double front_area_m2(const TetMesh& gel) {
  const FrontSurface front = make_front_surface(gel);
  const std::vector<double> areas = triangle_areas(front, on_front(front, gel.positions));
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

double radius_of(const Outcome& outcome, Kind kind, const std::string& formula) {
  if (outcome.spec.object.kind != kind)
    throw UsageError("the formula " + formula + " is for a " + (kind == Kind::sphere ? "sphere" : "punch"));
  return outcome.spec.object.radius_m;
}

/// Forces and stresses scale with the modulus, lengths and ratios do not.
bool scales_with_modulus(const std::string& unit) { return unit == "N" || unit == "Pa" || unit == "N m"; }

std::string unit_of(const std::string& quantity) {
  for (const Quantity& q : quantities())
    if (q.name == quantity) return q.unit;
  throw UsageError("there is no quantity '" + quantity + "'");
}

Row judge_row(const Expectation& e, const Outcome& outcome, double modulus_ratio) {
  const int frame = find_frame(outcome, e.frame);
  Row row{.label = e.label, .unit = unit_of(e.quantity), .measured = measure(outcome, e.quantity, frame)};
  if (scales_with_modulus(row.unit)) row.measured *= modulus_ratio;
  if (e.value) row.expected = *e.value;
  if (e.formula) row.expected = evaluate(*e.formula, outcome, frame, e.with_standoff);
  if (e.within_percent) {
    row.deviation = 100.0 * (row.measured - *row.expected) / std::abs(*row.expected);
    row.limit = fmt::format("within {:g} %", *e.within_percent);
    row.pass = std::abs(row.deviation) <= *e.within_percent;
  } else if (e.within) {
    row.deviation = row.measured - *row.expected;
    row.limit = fmt::format("within {:g}", *e.within);
    row.pass = std::abs(row.deviation) <= *e.within;
  } else if (e.at_most) {
    row.deviation = row.measured - *e.at_most;
    row.limit = fmt::format("at most {:g}", *e.at_most);
    row.pass = row.measured <= *e.at_most;
  } else {
    row.deviation = row.measured - *e.at_least;
    row.limit = fmt::format("at least {:g}", *e.at_least);
    row.pass = row.measured >= *e.at_least;
  }
  return row;
}

/// Compares front positions with those of another solver on the same mesh, in the last frame or in the worst of all.
std::vector<Row> compare_positions(const ReferenceSpec& spec, const Outcome& outcome,
                                   const std::filesystem::path& shared) {
  const NpyArray theirs = read_npy(resolve(spec.displacement, shared));
  const auto& frames = outcome.simulation.frames;
  const auto vertices = static_cast<std::size_t>(outcome.gel.num_vertices());
  if (theirs.shape.size() != 3 || theirs.shape[1] != vertices || theirs.shape[2] != 3 || theirs.shape[0] < 2)
    throw DataError("{}: not a displacement of the gel's {} vertices over frames", spec.displacement, vertices);
  const std::vector<int> front = outcome.gel.vertices(BoundaryTag::front);
  double worst_share_m = 0.0, worst_rms_m = 0.0;
  std::size_t worst_frame = 0;
  for (std::size_t f = spec.all_frames ? 1 : theirs.shape[0] - 1; f < theirs.shape[0]; ++f) {
    const std::size_t ours = f - 1 + static_cast<std::size_t>(spec.first_frame);
    if (ours >= frames.size()) throw DataError("frame {} of the reference has no counterpart", f);
    std::vector<double> difference;
    double squares = 0.0;
    for (const int v : front) {
      const double* d = theirs.data.data() + 3 * (f * vertices + static_cast<std::size_t>(v));
      const Vector3 moved = frames[ours].positions.row(v) - outcome.gel.positions.row(v);
      difference.push_back((moved - Vector3(d[0], d[1], d[2])).norm());
      squares += difference.back() * difference.back();
    }
    std::ranges::sort(difference);
    const auto last = static_cast<double>(difference.size() - 1);
    const double at_share = difference[static_cast<std::size_t>(spec.share_percent / 100.0 * last)];
    if (at_share > worst_share_m) worst_frame = ours;
    worst_share_m = std::max(worst_share_m, at_share);
    worst_rms_m = std::max(worst_rms_m, std::sqrt(squares / static_cast<double>(front.size())));
  }
  const auto row = [](const std::string& label, double measured, double limit) {
    return Row{
        label, "m", measured, std::nullopt, fmt::format("at most {:g}", limit), measured - limit, measured <= limit};
  };
  return {
      row(fmt::format("front positions, {:g} % of the vertices, worst in frame {}", spec.share_percent, worst_frame),
          worst_share_m, spec.largest_m),
      row("front positions, root mean square", worst_rms_m, spec.rms_m)};
}

}  // namespace

const std::vector<Formula>& formulas() {
  static const std::vector<Formula> list{
      {"hertz", "force of a sphere on a half space, paraboloid"},
      {"hertz_radius", "its contact radius"},
      {"sneddon", "force of a sphere on a half space, true shape"},
      {"bonded_layer", "force of a sphere on a bonded layer, exact linear solution"},
      {"bonded_layer_radius", "its contact radius"},
      {"dimitriadis", "force of a sphere on a bonded layer, series"},
      {"flat_punch", "force of a flat punch on a half space"},
      {"bonded_punch", "force of a flat punch on a bonded layer, exact linear solution"},
      {"layer_shear", "tangential force of a wide layer in shear, whole front"},
      {"disc_twist", "torque of a twisted disc between bonded faces"},
      {"friction_coefficient", "of the press configuration"},
      {"uniform_compression", "pressure of uniform compression with free sides"},
      {"relaxing_compression", "the same of a gel that relaxes, pressed at a constant rate and held"}};
  return list;
}

double evaluate(const std::string& formula, const Outcome& outcome, int frame, bool with_standoff) {
  const Elastic gel{outcome.spec.material.youngs_modulus_pa, outcome.spec.material.poissons_ratio};
  const double skin = with_standoff ? standoff_m(outcome, frame) : 0.0;
  const double depth = depth_m(outcome, frame) + skin, thickness = gel_thickness_m(outcome.gel);
  const auto sphere = [&] { return radius_of(outcome, Kind::sphere, formula) + skin; };
  const auto punch = [&] { return radius_of(outcome, Kind::punch, formula); };
  if (formula == "hertz") return hertz(gel, sphere(), depth).force_n;
  if (formula == "hertz_radius") return hertz(gel, sphere(), depth).contact_radius_m;
  if (formula == "sneddon") return sneddon_sphere(gel, sphere(), depth).force_n;
  const auto layer = [&](LayerProblem::Shape shape, double radius) {
    return press_bonded_layer({gel, thickness, shape, radius}, depth);
  };
  if (formula == "bonded_layer") return layer(LayerProblem::Shape::sphere, sphere()).force_n;
  if (formula == "bonded_layer_radius") return layer(LayerProblem::Shape::sphere, sphere()).contact_radius_m;
  if (formula == "dimitriadis") return dimitriadis_force_n(gel, thickness, sphere(), depth);
  if (formula == "flat_punch") return flat_punch_force_n(gel, punch(), depth);
  if (formula == "bonded_punch") return layer(LayerProblem::Shape::flat, punch()).force_n;
  if (formula == "layer_shear")
    return layer_shear_force_n(gel, thickness - depth, front_area_m2(outcome.gel), sideways_m(outcome, frame));
  if (formula == "disc_twist") {
    const double radius = std::sqrt(front_area_m2(outcome.gel) / std::numbers::pi);
    return disc_twist_torque_n_m(gel, radius, thickness - depth, turned_rad(outcome, frame));
  }
  const auto compression = [&] {
    return -uniform_compression(outcome.spec.material.law, gel, 1.0 - depth / thickness).true_stress_pa;
  };
  if (formula == "uniform_compression") return compression();
  if (formula == "relaxing_compression") {
    const auto& frames = outcome.simulation.frames;
    const double time_s = frames[frame].time_s;
    double ramp_s = 0.0;  // the first phase is the press
    for (const Frame& f : frames) ramp_s = f.phase_index == 0 ? std::min(f.time_s, time_s) : ramp_s;
    return compression() * relaxing_force_factor(outcome.spec.material.relaxation, ramp_s, time_s - ramp_s);
  }
  if (formula == "friction_coefficient")
    return outcome.spec.press.friction ? outcome.spec.press.friction->coefficient : 0.0;
  throw UsageError("there is no formula '" + formula + "'");
}

bool Judgement::pass() const {
  return std::ranges::all_of(rows, [](const Row& row) { return row.pass; });
}

Judgement judge(const Outcome& outcome, const std::filesystem::path& shared) {
  Judgement out;
  double ratio = 1.0;
  if (const auto& fit = outcome.spec.fit) {
    const double measured = measure(outcome, "press_force_n", find_frame(outcome, fit->frame));
    if (!(measured > 0.0)) throw DataError("the frame that fits the modulus carries no force");
    ratio = fit->press_force_n / measured;
    out.fitted_modulus_pa = ratio * outcome.spec.material.youngs_modulus_pa;
  }
  for (const Expectation& e : outcome.spec.expect) out.rows.push_back(judge_row(e, outcome, ratio));
  if (outcome.spec.reference) {
    const auto rows = compare_positions(*outcome.spec.reference, outcome, shared);
    out.rows.insert(out.rows.end(), rows.begin(), rows.end());
  }
  return out;
}

}  // namespace tacipc::verify
