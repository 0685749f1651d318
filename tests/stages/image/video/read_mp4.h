// Reads a video back by FFmpeg's own demuxer and decoder.
#pragma once

#include <gtest/gtest.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <filesystem>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

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
  SwsContext* scale = sws_getContext(codec->width, codec->height, codec->pix_fmt, codec->width, codec->height,
                                     AV_PIX_FMT_RGB24, SWS_BICUBIC | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
  sws_setColorspaceDetails(scale, sws_getCoefficients(SWS_CS_ITU709), 0, sws_getCoefficients(SWS_CS_ITU709), 1, 0,
                           1 << 16, 1 << 16);
  AVFrame* frame = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();
  const auto take = [&](const AVPacket* coded) {
    avcodec_send_packet(codec, coded);
    while (avcodec_receive_frame(codec, frame) >= 0) {
      ByteImage image(frame->width, frame->height, 3);
      std::uint8_t* const pixels[] = {image.pixels.data()};
      const int row = 3 * image.width;
      sws_scale(scale, frame->data, frame->linesize, 0, frame->height, pixels, &row);
      out.images.push_back(std::move(image));
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
  sws_freeContext(scale);
  avcodec_free_context(&codec);
  avformat_close_input(&format);
  return out;
}

}  // namespace tacipc
