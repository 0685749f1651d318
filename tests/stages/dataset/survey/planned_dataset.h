// A planned dataset written by hand: `samples` presses of one gel in shards of two, every third a shear.
#pragma once

#include <fmt/core.h>

#include <string>

#include "tests/scratch_folder.h"

namespace tacipc {

class PlannedDataset {
 public:
  explicit PlannedDataset(int samples) {
    std::string csv = "id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder\n";
    for (int i = 0; i < samples; ++i) {
      csv += fmt::format("{},{},train,train,7,toy,coarse,star,{},{},samples/000/{}\n", id(i), i, motion(i), shard(i),
                         id(i));
      file(
          i, "sample.yaml",
          i % 3 == 2
              ? "motion: [{kind: press, depth_mm: 1, steps: 4, substeps: 9}, {kind: shear, distance_mm: 1, steps: 6}]\n"
              : "motion: {kind: press, depth_mm: 1, steps: 5}\n");
    }
    scratch_.file("set/plan/samples.csv", csv);
    scratch_.file("set/plan/dataset.yaml",
                  "seed: 5\noutputs:\n  shard_mb: 1\nstop_after_failures: 3\nsplits:\n  val: 0\n");
    scratch_.file("set/plan/plan.yaml", "stage: plan\ninputs:\n  render:\n    path: ../../render.yaml\n");
    scratch_.file("render.yaml", "subpixels: 2\nframes: last\n");
    scratch_.file("profile.yaml", "fields: all\n");
  }

  static std::string id(int i) { return fmt::format("toy__star__{}__{:06}", motion(i), i); }
  static const char* motion(int i) { return i % 3 == 2 ? "along" : "down"; }
  static std::string shard(int i) { return fmt::format("train-{:05}", i / 2); }
  std::filesystem::path path() const { return scratch_ / "set"; }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }
  std::filesystem::path sample(int i) const { return path() / "samples/000" / id(i); }
  std::filesystem::path profile() const { return scratch_ / "profile.yaml"; }
  void render_frames(const std::string& which) const { scratch_.file("render.yaml", "frames: " + which + "\n"); }
  void file(int i, const std::string& name, const std::string& text) const { write_file(sample(i) / name, text); }

  void make(int i, double press_s = 3.0) const {
    file(i, "press/press.yaml", "stage: press\noutputs:\n  log.csv: ab\n  frames/one.npy: cd\n");
    file(i, "press/log.csv", "x");
    file(i, "press/frames/one.npy", std::string(100000, 'x'));
    file(i, "press/press.timings.yaml",
         fmt::format("stage: press\nwall_s: 4\nprocessor_s: {}\npeak_memory_mb: 50\n", press_s));
    file(i, "render/render.yaml", "stage: render\noutputs:\n  \"a: b.png\": ab\n");
    file(i, "render/a: b.png", "x");
    file(i, "render/render.timings.yaml", "stage: render\nwall_s: 2\nprocessor_s: 1\npeak_memory_mb: 80\n");
  }
  void fail(int i) const { file(i, "press/press.failed.yaml", "stage: press\nmessage: no\n"); }

 private:
  ScratchFolder scratch_;
};

}  // namespace tacipc
