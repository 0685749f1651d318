// A dataset as plan and the stages leave it, written by hand: rows of a plan, and samples where wanted.
#pragma once

#include <fmt/core.h>

#include "common/format/csv.h"
#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sheared_folder.h"

namespace tacipc {

/// `root`/data with a plan of `samples` rows: two objects, two motions, train but for every fourth sample.
class DatasetFolder {
 public:
  DatasetFolder(const std::filesystem::path& root, int samples) : dataset_(root / "data") {
    std::string csv = "id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder\n";
    for (int i = 0; i < samples; ++i) {
      csv += csv_line({id(i), std::to_string(i), i % 4 == 3 ? "test" : "train", i % 2 == 0 ? "train" : "val", "7",
                       "toy", "coarse", i % 4 < 2 ? "star" : "gear", i % 2 == 0 ? "down" : "along",
                       "train-00000-of-00001", folder_name(i)});
    }
    write_file(plan(), csv);
    write_file(dataset_ / "plan/dataset.yaml",
               "seed: 5\nsampling: low_discrepancy\nmotions:\n"
               "  - name: down\n    samples: 2\n    placement: {center_mm: {x: [-2, 2], y: 0}, rotate_deg: [0, 90]}\n"
               "    motion: {kind: press, depth_mm: [0.3, 0.7], steps: 3}\n"
               "  - {name: along, samples: 1, file: along.yaml}\n");
  }

  static std::string id(int i) {
    return fmt::format("toy__{}__{}__{:06}", i % 4 < 2 ? "star" : "gear", i % 2 == 0 ? "down" : "along", i);
  }
  static std::string folder_name(int i) { return fmt::format("samples/{:03}/{}", i / 1000, id(i)); }
  const std::filesystem::path& dataset() const { return dataset_; }
  std::filesystem::path plan() const { return dataset_ / "plan/samples.csv"; }
  std::filesystem::path sample(int i) const { return dataset_ / folder_name(i); }

  /// A sheared sample with its times; the press does not name an object that is there.
  void make(int i) const {
    const std::filesystem::path folder = sample(i);
    write_file(folder / "sample.yaml", "motion: {kind: press, depth_mm: 0.5, steps: 2}\n");
    write_file(folder / "press/press.yaml", replaced(sheared_record(), "star-007", id(i)));
    write_sheared_arrays(folder / "press");
    write_file(folder / "press/press.timings.yaml",
               "stage: press\nthreads: 1\nwall_s: 4\nprocessor_s: 3\npeak_memory_mb: 50\n");
    write_file(folder / "render/render.yaml",
               "stage: render\nreference: synthetic\nsummary: {frames: [0, 4], max_indentation_mm: 0.5}\n"
               "outputs: {frame_0004/indentation.exr: 1, frame_0004/normal.png: 2}\n");
    write_file(folder / "render/render.timings.yaml",
               "stage: render\nthreads: 1\nwall_s: 2\nprocessor_s: 1.5\npeak_memory_mb: 80\n");
    for (const char* frame : {"frame_0000", "frame_0004"})
      for (const char* name : {"tactile.png", "normal.png"})
        write_flat_png(folder / "render" / frame / name, 64, 48, 90);
    write_exr(folder / "render/frame_0004/indentation.exr", FloatImage(64, 48, 1, 2e-4f), {"Y"});  // has no preview
  }
  /// A press that did not converge.
  void fail(int i) const {
    write_file(sample(i) / "sample.yaml", "motion: {kind: press, depth_mm: 0.5, steps: 2}\n");
    write_file(sample(i) / "press/press.failed.yaml",
               "stage: press\nname: " + id(i) +
                   "\nmessage: \"frame 2: <no way> on\"\nframe: 2\ncheck: force balance\nvalue: 0.5\nlimit: 0.001\n");
    write_file(sample(i) / "press/press.log", "2024-06-07 12:34:56.789 error: press: error: frame 2\n");
  }

 private:
  std::filesystem::path dataset_;
};

}  // namespace tacipc
