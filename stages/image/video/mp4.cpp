#include "stages/image/video/mp4.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr std::uint32_t kTicksPerSecond = 90000;
constexpr std::uint32_t kOne = 0x00010000;  // 16.16

/// Numbers, big-endian.
class Bytes {
 public:
  Bytes& u8(unsigned value) { return put(value, 1); }
  Bytes& u16(unsigned value) { return put(value, 2); }
  Bytes& u32(std::size_t value) { return put(value, 4); }
  Bytes& zeros(std::size_t count) {
    text_.append(count, '\0');
    return *this;
  }
  Bytes& text(std::string_view text) {
    text_ += text;
    return *this;
  }
  const std::string& str() const { return text_; }

 private:
  Bytes& put(std::size_t value, int count) {
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) text_ += static_cast<char>(value >> shift & 0xff);
    return *this;
  }
  std::string text_;
};

/// A box: its length, its name, what is in it.
std::string box(std::string_view name, const std::string& content) {
  return Bytes().u32(content.size() + 8).text(name).text(content).str();
}

/// The same with version 0 and these flags.
std::string full_box(std::string_view name, std::size_t flags, const std::string& content) {
  return box(name, Bytes().u32(flags).text(content).str());
}

Bytes& matrix(Bytes& bytes) {
  for (const std::uint32_t entry : {kOne, 0U, 0U, 0U, kOne, 0U, 0U, 0U, 0x40000000U}) bytes.u32(entry);
  return bytes;
}

/// Ticks that each frame is shown: from the rounded beginning to the rounded end, so that errors do not add up.
std::vector<std::uint32_t> ticks_of(const std::vector<double>& seconds) {
  std::vector<std::uint32_t> ticks;
  double time_s = 0.0;
  for (const double shown_s : seconds) {
    const double begin = std::round(time_s * kTicksPerSecond);
    time_s += shown_s;
    ticks.push_back(static_cast<std::uint32_t>(std::max(1.0, std::round(time_s * kTicksPerSecond) - begin)));
  }
  return ticks;
}

/// avc1: size, the decoder's parameters, and what the colours mean (BT.709, narrow range).
std::string sample_entry(const Mp4Track& track) {
  const std::string& sps = track.sequence_parameters;
  assert(sps.size() >= 4);
  Bytes config;
  config.u8(1).text(sps.substr(1, 3)).u8(0xff).u8(0xe1);  // profile and level; lengths of four bytes; one set
  config.u16(static_cast<unsigned>(sps.size())).text(sps).u8(1);
  config.u16(static_cast<unsigned>(track.picture_parameters.size())).text(track.picture_parameters);
  // High profile: 4:2:0, 8 bit, no extensions.
  if (static_cast<unsigned char>(sps[1]) == 100) config.u8(0xfd).u8(0xf8).u8(0xf8).u8(0);
  Bytes entry;
  entry.zeros(6).u16(1).zeros(16).u16(static_cast<unsigned>(track.width)).u16(static_cast<unsigned>(track.height));
  entry.u32(0x00480000).u32(0x00480000).u32(0).u16(1).zeros(32).u16(0x0018).u16(0xffff);  // 72 dpi, 24 bit
  entry.text(box("avcC", config.str()));
  entry.text(box("colr", Bytes().text("nclx").u16(1).u16(1).u16(1).u8(0).str()));
  return box("avc1", entry.str());
}

/// stbl: when frames are shown, which are keys, how long they are, and where they lie.
std::string sample_table(const Mp4Track& track, const std::vector<std::uint32_t>& ticks, std::size_t first_byte) {
  Bytes shown, keys, sizes;
  std::size_t runs = 0, key_count = 0;
  for (std::size_t begin = 0, end; begin < ticks.size(); begin = end, ++runs) {
    for (end = begin; end < ticks.size() && ticks[end] == ticks[begin];) ++end;
    shown.u32(end - begin).u32(ticks[begin]);
  }
  for (std::size_t f = 0; f < track.frames.size(); ++f) {
    sizes.u32(track.frames[f].bytes.size());
    if (!track.frames[f].key) continue;
    keys.u32(f + 1);
    ++key_count;
  }
  const std::size_t count = track.frames.size();
  return box("stbl", full_box("stsd", 0, Bytes().u32(1).text(sample_entry(track)).str()) +
                         full_box("stts", 0, Bytes().u32(runs).text(shown.str()).str()) +
                         full_box("stss", 0, Bytes().u32(key_count).text(keys.str()).str()) +
                         full_box("stsc", 0, Bytes().u32(1).u32(1).u32(count).u32(1).str()) +
                         full_box("stsz", 0, Bytes().u32(0).u32(count).text(sizes.str()).str()) +
                         full_box("stco", 0, Bytes().u32(1).u32(first_byte).str()));
}

/// moov. \param first_byte of the frames in the file
std::string index_of(const Mp4Track& track, std::size_t first_byte) {
  const std::vector<std::uint32_t> ticks = ticks_of(track.seconds);
  std::uint64_t whole = 0;
  for (const std::uint32_t t : ticks) whole += t;
  if (whole > std::numeric_limits<std::uint32_t>::max()) throw DataError("a film of more than 13 hours is not written");
  Bytes movie, header;
  movie.zeros(8).u32(kTicksPerSecond).u32(whole).u32(kOne).u16(0x0100).zeros(10);
  matrix(movie).zeros(24).u32(2);
  header.zeros(8).u32(1).zeros(4).u32(whole).zeros(16);
  matrix(header).u32(static_cast<std::size_t>(track.width) << 16).u32(static_cast<std::size_t>(track.height) << 16);
  constexpr unsigned kNoLanguage = 0x55c4;  // "und"
  const std::string media =
      full_box("mdhd", 0, Bytes().zeros(8).u32(kTicksPerSecond).u32(whole).u16(kNoLanguage).u16(0).str()) +
      full_box("hdlr", 0, Bytes().zeros(4).text("vide").zeros(12).text("video").zeros(1).str()) +
      box("minf", full_box("vmhd", 1, Bytes().zeros(8).str()) +
                      box("dinf", full_box("dref", 0, Bytes().u32(1).text(full_box("url ", 1, "")).str())) +
                      sample_table(track, ticks, first_byte));
  return box("moov",
             full_box("mvhd", 0, movie.str()) + box("trak", full_box("tkhd", 3, header.str()) + box("mdia", media)));
}

}  // namespace

std::string mp4_bytes(const Mp4Track& track) {
  assert(track.frames.size() == track.seconds.size() && !track.frames.empty());
  const std::string type = box("ftyp", Bytes().text("isom").u32(0x200).text("isomiso2avc1mp41").str());
  std::uint64_t length = 8;
  for (const CodedFrame& frame : track.frames) length += frame.bytes.size();
  // The index is as long wherever the frames begin.
  const std::size_t first_byte = type.size() + index_of(track, 0).size() + 8;
  if (first_byte + length > std::numeric_limits<std::uint32_t>::max())
    throw DataError("a film of {} frames is longer than 4 GiB", track.frames.size());
  std::string file = type + index_of(track, first_byte) + Bytes().u32(length).text("mdat").str();
  for (const CodedFrame& frame : track.frames) file += frame.bytes;
  return file;
}

}  // namespace tacipc
