// Reads a 3MF file: the root model's build, with objects of other parts by their paths.
#include <set>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/text_reader.h"
#include "common/mesh/threemf_model.h"
#include "common/mesh/zip_parts.h"

namespace tacipc {
namespace {

constexpr const char* kRelationships = "/_rels/.rels";
constexpr const char* kSlicerSettings = "/Metadata/Slic3r_PE_model.config";

std::string place_of(const std::string& name, const std::string& part) {
  return fmt::format("{}: {}", name, shown(part.starts_with('/') ? part.substr(1) : part));
}

class Assembly {
 public:
  Assembly(std::string_view bytes, const std::string& name) : name_(name), parts_(bytes, name) {}

  SceneMesh read() {
    if (!parts_.has(kRelationships))
      throw DataError("{}: is not a 3MF file (the archive has no {})", name_, kRelationships + 1);
    const std::string links = place_of(name_, kRelationships);
    const std::string root_part = root_part_of(parts_.read({kRelationships}).front(), links);
    if (!parts_.has(root_part))
      throw DataError("{}: names a root model, {}, that is not there", links, shown(root_part));
    root_.place = place_of(name_, root_part);
    root_.model = read_threemf_model(parts_.read({root_part}).front(), root_.place, ThreeMfBuild::read);
    if (root_.model.items.empty())
      throw DataError("{}: its build has no items, so there is nothing to read", root_.place);
    read_others();
    for (const ThreeMfReference& item : root_.model.items) place(root_, item, Eigen::Affine3d::Identity(), 0);
    if (supports_ > 0) log_info("{}: {} meshes of supports and the like are left out", name_, supports_);
    warn_of_modifiers();
    return {.mesh = joined_parts(placed_, name_), .unit = unit()};
  }

 private:
  struct Part {
    std::string place;
    ThreeMfModel model;
  };

  std::string unit() const { return root_.model.unit.value_or("mm"); }

  void warn_of_modifiers() {
    if (!parts_.has(kSlicerSettings)) return;
    const std::string kinds =
        volumes_that_are_no_parts(parts_.read({kSlicerSettings}).front(), place_of(name_, kSlicerSettings));
    if (!kinds.empty())
      log_warning("{}: its slicer counts some of its triangles as {}; they are read as parts of the object", name_,
                  kinds);
  }

  /// Reads the parts that the build needs in addition to the root model. Only the root model may name others.
  void read_others() {
    std::set<std::string> paths;
    std::set<int> seen;
    std::vector<const ThreeMfReference*> left;
    for (const ThreeMfReference& item : root_.model.items) left.push_back(&item);
    while (!left.empty()) {
      const ThreeMfReference& reference = *left.back();
      left.pop_back();
      if (reference.path) {
        paths.insert(*reference.path);
      } else if (const auto object = root_.model.objects.find(reference.object);
                 object != root_.model.objects.end() && seen.insert(reference.object).second) {
        for (const ThreeMfReference& component : object->second.components) left.push_back(&component);
      }
    }
    for (const std::string& path : paths)
      if (!parts_.has(path)) throw DataError("{}: names the part {}, which is not there", root_.place, shown(path));
    const std::vector<std::string> ordered(paths.begin(), paths.end());
    std::vector<std::string> texts = parts_.read(ordered);
    for (std::size_t i = 0; i < ordered.size(); ++i) {
      const std::string where = place_of(name_, ordered[i]);
      Part& part = others_[ordered[i]];
      part = {where, read_threemf_model(std::move(texts[i]), where, ThreeMfBuild::ignore)};
      if (part.model.unit.value_or(unit()) != unit())
        throw DataError("{}: its unit is {}, that of the root model {}", where, *part.model.unit, unit());
    }
  }

  void place(const Part& from, const ThreeMfReference& reference, const Eigen::Affine3d& outer, int depth) {
    if (depth > kDeepestPlacement)
      throw DataError("{}: object {}: components are nested more than {} deep, or in a circle", from.place,
                      reference.object, kDeepestPlacement);
    if (++placements_ > kMostPlacements) throw DataError("{}: places more than {} objects", name_, kMostPlacements);
    if (reference.path && &from != &root_)
      throw DataError("{}: names another part, {}, as only the root model may", from.place, shown(*reference.path));
    const Part& part = reference.path ? others_.at(*reference.path) : from;
    const auto found = part.model.objects.find(reference.object);
    if (found == part.model.objects.end())
      throw DataError("{}: has no object {}, which {} names", part.place, reference.object,
                      &part == &from ? "it" : "the root model");
    const ThreeMfObject& object = found->second;
    if (!object.unread.empty()) throw DataError("{}: object {} {}", part.place, reference.object, object.unread);
    const Eigen::Affine3d here = outer * reference.placement;
    for (const ThreeMfReference& component : object.components) place(part, component, here, depth + 1);
    if (!object.components.empty()) return;
    if (object.type != "model" && object.type != "surface")
      ++supports_;
    else
      placed_.push_back({&object.mesh, here});
  }

  const std::string& name_;
  ZipParts parts_;
  Part root_;
  std::map<std::string, Part> others_;
  std::vector<PlacedPart> placed_;
  std::size_t placements_ = 0, supports_ = 0;
};

}  // namespace

SceneMesh read_3mf(std::string_view bytes, const std::string& name) { return Assembly(bytes, name).read(); }

}  // namespace tacipc
