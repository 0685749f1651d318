#include "stages/gel/press/drive/scene_spec.h"

#include <algorithm>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {
namespace {

BodySpec read_body(ConfigReader& in) {
  BodySpec body;
  body.name = read_body_name(in, "name");
  const std::string kind = in.choice("kind", {kBodyKinds.begin(), kBodyKinds.end()});
  body.kind = static_cast<BodyKind>(std::find(kBodyKinds.begin(), kBodyKinds.end(), kind) - kBodyKinds.begin());
  const std::filesystem::path folder = std::filesystem::path(in.source()).parent_path();
  if (body.kind != BodyKind::gel) body.mesh = folder / in.text("mesh");
  if (body.kind == BodyKind::soft) body.material = folder / in.text("material");
  if (body.kind == BodyKind::rigid || body.kind == BodyKind::fixed)
    body.metres_per_unit = metres_per_unit(in.choice_or("unit", "m", kLengthUnits));
  if (body.kind == BodyKind::rigid) {
    body.mass = read_body_mass(in);
    body.velocity_m_s = read_triple(in, "velocity_mm_s", 1e-3);
    body.spin_rad_s = read_triple(in, "spin_rad_s", 1.0);
  }
  if (in.has("path")) {
    if (body.kind != BodyKind::gel && body.kind != BodyKind::rigid)
      in.fault("path", "gels and rigid bodies can go along a path");
    for (const char* key : {"at_mm", "turn_deg", "velocity_mm_s", "spin_rad_s"}) {
      if (in.has(key)) in.fault(key, "a body with a path starts where that does, and goes as that does");
    }
    body.path = folder / in.text("path");
  }
  body.world_from_body = moved(Matrix4::Identity(), {read_triple(in, "at_mm", 1e-3), read_turn(in, "turn_deg")});
  return body;
}

/// Names of bodies that a file may refer to.
class Names {
 public:
  explicit Names(const std::vector<BodySpec>& bodies) : bodies_(bodies) {
    for (const BodySpec& body : bodies) names_.push_back(body.name);
  }
  int number(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? 0 : static_cast<int>(found - names_.begin());
  }
  int read(ConfigReader& in, const std::string& key) const { return number(in.choice(key, names_)); }
  const std::vector<std::string>& all() const { return names_; }
  bool has_path(int body) const { return !bodies_[static_cast<std::size_t>(body)].path.empty(); }
  BodyKind kind(int body) const { return bodies_[static_cast<std::size_t>(body)].kind; }

 private:
  const std::vector<BodySpec>& bodies_;
  std::vector<std::string> names_;
};

ScenePhase read_phase(ConfigReader& in, const Names& names) {
  ScenePhase phase;
  phase.steps = in.integer("steps", 1, 100000);
  phase.substeps = in.integer_or("substeps", 1, 1, 1000);
  const double time_steps = static_cast<double>(phase.steps) * phase.substeps;
  const auto once = [&](ConfigReader& at, const std::string& key, int body, const std::string& reason) {
    if (names.has_path(body)) at.fault(key, "this body goes along its path in every phase");
    for (const WaySpec& way : phase.move) {
      if (way.body == body) at.fault(key, reason);
    }
    for (const int other : phase.hold) {
      if (other == body) at.fault(key, reason);
    }
  };
  const std::string twice = "this body is moved or held twice in the phase";
  for (ConfigReader& move : in.sections("move")) {
    WaySpec way;
    way.body = names.read(move, "body");
    if (names.kind(way.body) != BodyKind::gel && names.kind(way.body) != BodyKind::rigid)
      move.fault("body", "gels and rigid bodies can be moved; a soft one goes with what it touches");
    once(move, "body", way.body, twice);
    way.way = {read_triple(move, "by_mm", 1e-3), read_turn(move, "turn_deg")};
    way.smooth = move.flag_or("smooth", false);
    // Halfway through a smooth motion the speed is 3/2 of the mean.
    if ((way.smooth ? 1.5 : 1.0) * way.way.turn_rad.norm() / time_steps > kLongestTurn_rad)
      move.fault("turn_deg", "a body turns by at most 0.2 rad (11.5°) in a time step: give the phase more steps");
    phase.move.push_back(way);
  }
  for (const std::string& name : in.choices_or("hold", {}, names.all())) {
    const int body = names.number(name);
    if (names.kind(body) != BodyKind::rigid) in.fault("hold", name + " is not a rigid body: those alone are free");
    once(in, "hold", body, twice);
    phase.hold.push_back(body);
  }
  for (ConfigReader& load : in.sections("load")) {
    const int body = names.read(load, "body");
    if (names.kind(body) != BodyKind::rigid) load.fault("body", "a load acts on a rigid body");
    const Vector3 force = load.vector3("force_n");
    for (const auto& [other, unused] : phase.load_n) {
      if (other == body) load.fault("body", "this body has another load in the phase");
    }
    once(load, "body", body, "a body that is moved or held bears no load");
    phase.load_n.emplace_back(body, force);
  }
  return phase;
}

}  // namespace

int SceneSpec::count(BodyKind kind) const {
  return static_cast<int>(
      std::count_if(bodies.begin(), bodies.end(), [&](const BodySpec& body) { return body.kind == kind; }));
}

SceneSpec SceneSpec::read(ConfigReader& in) {
  SceneSpec spec;
  const auto gravity = in.numbers_or("gravity_m_s2", {0.0, 0.0, -9.81});
  spec.gravity_m_s2 = {gravity[0], gravity[1], gravity[2]};
  spec.time_step_s = in.optional_number("time_step_s", Range::positive());
  for (ConfigReader& body : in.one_or_more_sections("bodies")) {
    spec.bodies.push_back(read_body(body));
    for (std::size_t i = 0; i + 1 < spec.bodies.size(); ++i) {
      if (spec.bodies[i].name == spec.bodies.back().name) body.fault("name", "another body has this name");
    }
  }
  if (spec.count(BodyKind::gel) == 0) in.fault("bodies", "a scene has at least one gel");
  std::stable_sort(spec.bodies.begin(), spec.bodies.end(),
                   [](const BodySpec& a, const BodySpec& b) { return a.kind < b.kind; });
  const Names names(spec.bodies);
  for (ConfigReader& pair : in.sections("contact")) {
    ContactSpec contact;
    const std::vector<std::string> between = pair.choices_or("between", {}, names.all());
    if (between.size() != 2) {
      pair.fault("between", "expected the names of two bodies");
    } else {
      contact.between = {names.number(between[0]), names.number(between[1])};
    }
    for (const ContactSpec& other : spec.contact) {
      if (std::minmax(other.between[0], other.between[1]) == std::minmax(contact.between[0], contact.between[1]))
        pair.fault("between", "these two stand in the list already");
    }
    contact.friction = pair.optional_number("friction", Range::non_negative());
    if (const auto d_hat_mm = pair.optional_number("d_hat_mm", Range::positive())) contact.d_hat_m = 1e-3 * *d_hat_mm;
    spec.contact.push_back(contact);
  }
  for (ConfigReader& phase : in.one_or_more_sections("motion")) spec.motion.push_back(read_phase(phase, names));
  return spec;
}

}  // namespace tacipc
