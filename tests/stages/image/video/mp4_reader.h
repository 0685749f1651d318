// Reads an MP4 file of one track back: its boxes, and its frames by OpenH264's decoder.
#pragma once

#include <gtest/gtest.h>
#include <wels/codec_api.h>

#include <map>
#include <string>
#include <vector>

#include "common/base/byte_reader.h"
#include "stages/image/video/yuv.h"

namespace tacipc {

struct ReadMp4 {
  std::vector<std::string> order;  // of the boxes of the file
  unsigned timescale = 0, duration = 0, width = 0, height = 0;
  std::vector<unsigned> ticks;  // of each frame
  std::vector<unsigned> keys;   // from 1 on
  std::string sequence, picture;
  std::vector<std::string> frames;  // with start codes
};

inline std::string start_code() { return std::string("\0\0\0\1", 4); }

/// Walks over the boxes; those that hold others are gone into.
inline void read_boxes(const std::string& file, std::size_t begin, std::size_t end, ReadMp4& out,
                       std::map<std::string, std::string>& found, bool top) {
  while (begin < end) {
    ByteReader in(std::string_view(file).substr(begin), "mp4", std::endian::big);
    const auto length = in.read<std::uint32_t>("length");
    const std::string name = file.substr(begin + 4, 4);
    ASSERT_GE(length, 8u) << name;
    ASSERT_LE(begin + length, end) << name;
    if (top) out.order.push_back(name);
    if (name == "moov" || name == "trak" || name == "mdia" || name == "minf" || name == "stbl" || name == "dinf") {
      read_boxes(file, begin + 8, begin + length, out, found, false);
    } else {
      found[name] = file.substr(begin + 8, length - 8);
    }
    begin += length;
  }
}

inline ReadMp4 read_mp4(const std::string& file) {
  ReadMp4 out;
  std::map<std::string, std::string> found;
  read_boxes(file, 0, file.size(), out, found, true);
  const auto numbers = [&](const std::string& name) { return ByteReader(found.at(name), name, std::endian::big); };
  auto u32 = [](ByteReader& in) { return in.read<std::uint32_t>("a number"); };
  ByteReader header = numbers("mdhd");
  header.skip(12, "times");
  out.timescale = u32(header), out.duration = u32(header);
  ByteReader track = numbers("tkhd");
  track.skip(76, "matrix");
  out.width = u32(track) >> 16, out.height = u32(track) >> 16;
  ByteReader shown = numbers("stts");
  shown.skip(4, "flags");
  for (unsigned runs = u32(shown); runs > 0; --runs) {
    const unsigned count = u32(shown), ticks = u32(shown);
    out.ticks.insert(out.ticks.end(), count, ticks);
  }
  ByteReader keys = numbers("stss");
  keys.skip(4, "flags");
  for (unsigned count = u32(keys); count > 0; --count) out.keys.push_back(u32(keys));
  const std::string& entry = found.at("stsd");
  const std::size_t config = entry.find("avcC") + 4;
  const auto set_at = [&](std::size_t at) {
    const std::size_t size = static_cast<unsigned char>(entry[at]) * 256U + static_cast<unsigned char>(entry[at + 1]);
    return entry.substr(at + 2, size);
  };
  out.sequence = set_at(config + 6);
  out.picture = set_at(config + 6 + 2 + out.sequence.size() + 1);
  ByteReader sizes = numbers("stsz"), places = numbers("stco");
  sizes.skip(8, "flags"), places.skip(8, "flags");
  std::size_t at = u32(places);
  for (unsigned count = u32(sizes); count > 0; --count) {
    const std::size_t size = u32(sizes);
    std::string frame;
    for (std::size_t unit = at; unit < at + size;) {
      const std::size_t length =
          ByteReader(std::string_view(file).substr(unit), "unit", std::endian::big).read<std::uint32_t>("length");
      frame += start_code() + file.substr(unit + 4, length);
      unit += 4 + length;
    }
    out.frames.push_back(frame);
    at += size;
  }
  EXPECT_EQ(at, file.size()) << "frames end where the file ends";
  return out;
}

/// Every frame as RGB.
inline std::vector<ByteImage> decoded(const ReadMp4& film) {
  std::vector<ByteImage> images;
  ISVCDecoder* decoder = nullptr;
  EXPECT_EQ(WelsCreateDecoder(&decoder), 0);
  SDecodingParam parameters{};
  parameters.sVideoProperty.eVideoBsType = VIDEO_BITSTREAM_AVC;
  EXPECT_EQ(decoder->Initialize(&parameters), 0);
  std::string before = start_code() + film.sequence + start_code() + film.picture;
  const auto take = [&](unsigned char** planes, const SBufferInfo& info) {
    if (info.iBufferStatus != 1) return;
    const SSysMEMBuffer& buffer = info.UsrData.sSystemBuffer;
    YuvImage yuv{buffer.iWidth, buffer.iHeight, {}, {}, {}};
    for (int y = 0; y < yuv.height; ++y)
      yuv.y.insert(yuv.y.end(), planes[0] + y * buffer.iStride[0], planes[0] + y * buffer.iStride[0] + yuv.width);
    for (int y = 0; y < yuv.height / 2; ++y) {
      const int row = y * buffer.iStride[1];
      yuv.cb.insert(yuv.cb.end(), planes[1] + row, planes[1] + row + yuv.width / 2);
      yuv.cr.insert(yuv.cr.end(), planes[2] + row, planes[2] + row + yuv.width / 2);
    }
    images.push_back(rgb_of(yuv));
  };
  for (const std::string& frame : film.frames) {
    const std::string bytes = before + frame;
    before.clear();
    unsigned char* planes[3] = {};
    SBufferInfo info{};
    EXPECT_EQ(decoder->DecodeFrameNoDelay(reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<int>(bytes.size()), planes, &info),
              0);
    take(planes, info);
  }
  while (images.size() < film.frames.size()) {  // those that wait for others to be sorted
    const std::size_t so_far = images.size();
    unsigned char* planes[3] = {};
    SBufferInfo info{};
    decoder->FlushFrame(planes, &info);
    take(planes, info);
    if (images.size() == so_far) break;
  }
  decoder->Uninitialize();
  WelsDestroyDecoder(decoder);
  return images;
}

}  // namespace tacipc
