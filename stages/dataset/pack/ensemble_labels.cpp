#include "stages/dataset/pack/ensemble_labels.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/placement.h"
#include "common/sample/sample_status.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr const char* kRecord = "press.yaml";

}  // namespace

LabelledPress::LabelledPress(fs::path folder, const Positions& object_m)
    : per_frame_(summary_of<PressSummary>(Record::from_file(folder / kRecord)).sections(&PressSummary::per_frame)),
      arrays_(PressFolder::finished(folder, {{kFrames, per_frame_.size()}})),
      object_m_(object_m),
      front_(arrays_.front_vertices()),
      rest_m_(arrays_.positions(0)) {}

std::vector<double> LabelledPress::label(EnsembleLabel label, std::size_t frame) const {
  const auto& lines = per_frame_[frame];
  switch (label) {
    case EnsembleLabel::press_force: return {lines.required(&PressFrameLines::press_force_n)};
    case EnsembleLabel::tangential_force: return {lines.required(&PressFrameLines::tangential_force_n)};
    case EnsembleLabel::torque: {
      const Vector3 torque = arrays_.wrenches()[frame].torque_n_m;
      return {torque.begin(), torque.end()};
    }
    case EnsembleLabel::contact_area: return {lines.required(&PressFrameLines::contact_area_mm2)};
    case EnsembleLabel::deepest_indentation: {
      const Positions x = arrays_.positions(frame);
      double deepest = 0.0;
      for (const int v : front_) deepest = std::max(deepest, rest_m_(v, 2) - x(v, 2));
      return {deepest};
    }
    case EnsembleLabel::object_depth: return {0.0 - transformed(arrays_.poses()[frame], object_m_).col(2).minCoeff()};
  }
  return {};
}

EnsembleLabels::EnsembleLabels(const DatasetEnsemble& ensemble, const fs::path& sample_folder,
                               const fs::path& object_mesh)
    : ensemble_(ensemble), object_m_(read_triangle_mesh(object_mesh, 1.0).positions) {
  sample_.emplace(sample_folder / "press", object_m_);
  for (const std::string& name : ensemble_.presses()) {
    const fs::path folder = member_press(sample_folder, name);
    if (!fs::exists(folder / kRecord)) {
      missing_.push_back(name);
      continue;
    }
    if (was_dropped(folder))
      throw DataError("{}: was dropped after packing and cannot be packed again; clean-press, then it is made again",
                      folder.string());
    LabelledPress press(folder, object_m_);
    if (press.frames() != sample_->frames())
      throw DataError("{}: has {} frames, the sample {}", folder.string(), press.frames(), sample_->frames());
    if (name == kNominal) {
      nominal_.emplace(std::move(press));
    } else {
      members_.push_back(std::move(press));
      made_.push_back(name);
    }
  }
}

std::optional<std::vector<double>> EnsembleLabels::sigma(EnsembleLabel label, std::size_t frame) const {
  const auto n = static_cast<double>(members_.size());
  if (members_.size() < 2) return std::nullopt;
  std::vector<std::vector<double>> all;
  for (const LabelledPress& member : members_) all.push_back(member.label(label, frame));
  std::vector<double> sigma(all.front().size());
  for (std::size_t k = 0; k < sigma.size(); ++k) {
    double mean = 0.0, squares = 0.0;
    for (const auto& values : all) mean += values[k] / n;
    for (const auto& values : all) squares += (values[k] - mean) * (values[k] - mean);
    sigma[k] = std::sqrt(squares / (n - 1.0));
  }
  return sigma;
}

std::optional<std::vector<double>> EnsembleLabels::mesh_difference(EnsembleLabel label, std::size_t frame) const {
  if (!nominal_) return std::nullopt;
  std::vector<double> difference = nominal_->label(label, frame);
  const std::vector<double> own = sample_->label(label, frame);
  for (std::size_t k = 0; k < own.size(); ++k) difference[k] -= own[k];
  return difference;
}

bool EnsembleLabels::any_mount_gives_way() const {
  return sample_->mount_gives_way() || std::any_of(members_.begin(), members_.end(), [](const LabelledPress& member) {
           return member.mount_gives_way();
         });
}

}  // namespace tacipc
