#include "common/sample/rendered_frames.h"

namespace tacipc {

RenderedFrames read_rendered_frames(ConfigReader& in) {
  const std::string frames = in.choice_or("frames", "last", {"last", "phases", "all"});
  return frames == "all" ? RenderedFrames::all : frames == "phases" ? RenderedFrames::phases : RenderedFrames::last;
}

RenderedFrames read_rendered_frames(const std::filesystem::path& config) {
  ConfigReader in = ConfigReader::from_file(config);
  const RenderedFrames frames = read_rendered_frames(in);
  for (const std::string& key : in.keys()) in.ignore(key);
  in.finish();
  return frames;
}

int count_rendered(RenderedFrames which, int frames, const std::vector<std::string>& kinds) {
  if (which == RenderedFrames::all) return 1 + frames;
  if (which == RenderedFrames::last) return 2;
  int count = 1;
  for (std::size_t p = 0; p < kinds.size(); ++p) count += p == 0 || kinds[p] != kinds[p - 1] ? 1 : 0;
  return count;
}

}  // namespace tacipc
