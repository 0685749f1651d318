// Reads a video back by FFmpeg's own demuxer and decoder.
#pragma once

#include <gtest/gtest.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// Of 4:2:0 in narrow range, by the equations of BT.709, with the nearest sample of colour.
inline ByteImage rgb_of(const AVFrame& frame) {
  ByteImage image(frame.width, frame.height, 3);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto sample = [&](int plane, int shrunk) {
        return double{1} * frame.data[plane][(y / shrunk) * frame.linesize[plane] + x / shrunk];
      };
      const double grey = (sample(0, 1) - 16.0) / 219.0, blue = (sample(1, 2) - 128.0) / 224.0,
                   red = (sample(2, 2) - 128.0) / 224.0;
      const double r = grey + 1.5748 * red, b = grey + 1.8556 * blue, g = (grey - 0.2126 * r - 0.0722 * b) / 0.7152;
      int channel = 0;
      for (const double part : {r, g, b})
        image.at(x, y, channel++) = static_cast<std::uint8_t>(std::lround(std::clamp(255.0 * part, 0.0, 255.0)));
    }
  }
  return image;
}

struct ReadMp4 {
  std::vector<ByteImage> images;  // RGB
  std::vector<double> seconds;    // for which each is shown
  std::vector<unsigned> keys;     // frames that are coded by themselves, from 0
  double whole_s = 0.0;
};

inline ReadMp4 read_mp4(const std::filesystem::path& path) {
  ReadMp4 out;
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, path.c_str(), nullptr, nullptr) < 0 ||
      avformat_find_stream_info(format, nullptr) < 0) {
    ADD_FAILURE() << path << " is no video";
    return out;
  }
  const AVStream& stream = *format->streams[0];
  out.whole_s = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  AVCodecContext* codec = avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id));
  avcodec_parameters_to_context(codec, stream.codecpar);
  EXPECT_EQ(codec->codec_id, AV_CODEC_ID_H264);
  EXPECT_EQ(codec->colorspace, AVCOL_SPC_BT709);
  EXPECT_EQ(avcodec_open2(codec, codec->codec, nullptr), 0);
  AVFrame* frame = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();
  const auto take = [&](const AVPacket* coded) {
    avcodec_send_packet(codec, coded);
    while (avcodec_receive_frame(codec, frame) >= 0) {
      out.images.push_back(rgb_of(*frame));
    }
  };
  while (av_read_frame(format, packet) >= 0) {
    if (packet->flags & AV_PKT_FLAG_KEY) out.keys.push_back(static_cast<unsigned>(out.seconds.size()));
    out.seconds.push_back(static_cast<double>(packet->duration) * av_q2d(stream.time_base));
    take(packet);
    av_packet_unref(packet);
  }
  take(nullptr);
  av_packet_free(&packet);
  av_frame_free(&frame);
  avcodec_free_context(&codec);
  avformat_close_input(&format);
  return out;
}

}  // namespace tacipc
