#include "stages/image/video/mp4_file.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr AVRational kTick{1, 90000};
constexpr int kKeyEvery = 50;  // frames between key frames, to which players can jump

}  // namespace

namespace mp4_file {

template <auto free>
struct Free {
  template <typename T>
  void operator()(T* object) const {
    free(&object);
  }
};
using Codec = std::unique_ptr<AVCodecContext, Free<avcodec_free_context>>;
using FramePtr = std::unique_ptr<AVFrame, Free<av_frame_free>>;
using PacketPtr = std::unique_ptr<AVPacket, Free<av_packet_free>>;

struct FreeFormat {
  void operator()(AVFormatContext* format) const {
    avio_closep(&format->pb);
    avformat_free_context(format);
  }
};
struct FreeScale {
  void operator()(SwsContext* scale) const { sws_freeContext(scale); }
};

}  // namespace mp4_file

struct Mp4File::Parts {
  std::string name;
  std::unique_ptr<AVFormatContext, mp4_file::FreeFormat> format;
  mp4_file::Codec codec;
  std::unique_ptr<SwsContext, mp4_file::FreeScale> scale;
  mp4_file::FramePtr frame;
  mp4_file::PacketPtr packet;
  double shown_s = 0.0;             // total duration of the frames so far
  std::vector<std::int64_t> ticks;  // duration of each frame
  std::size_t written = 0;

  /// \throw DataError if a call of a library has failed
  int check(int code) const {
    if (code >= 0) return code;
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    throw DataError("{}: cannot be written: {}", name, av_make_error_string(text.data(), text.size(), code));
  }

  void open_codec(int width, int height) {
    const AVCodec* x264 = avcodec_find_encoder_by_name("libx264");
    if (x264 == nullptr) throw DataError("{}: cannot be written: libavcodec has no encoder libx264", name);
    codec.reset(avcodec_alloc_context3(x264));
    AVCodecContext& c = *codec;
    c.width = width;
    c.height = height;
    c.pix_fmt = AV_PIX_FMT_YUV420P;
    c.time_base = kTick;
    c.gop_size = kKeyEvery;
    c.max_b_frames = 0;  // frames leave in the order of their arrival
    c.thread_count = 1;
    c.color_range = AVCOL_RANGE_MPEG;
    c.colorspace = AVCOL_SPC_BT709;
    c.color_primaries = AVCOL_PRI_BT709;
    c.color_trc = AVCOL_TRC_BT709;
    c.flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
    check(av_opt_set(c.priv_data, "crf", "18", 0));
    check(avcodec_open2(&c, x264, nullptr));
  }

  void open_scale(int width, int height) {
    scale.reset(sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height, AV_PIX_FMT_YUV420P,
                               SWS_AREA | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_BITEXACT, nullptr, nullptr,
                               nullptr));
    if (!scale) throw DataError("{}: frames of {} x {} pixels cannot be converted", name, width, height);
    constexpr int kFull = 1, kNarrow = 0, kNeutral = 1 << 16;
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(scale.get(), bt709, kFull, bt709, kNarrow, 0, kNeutral, kNeutral);
    frame.reset(av_frame_alloc());
    frame->format = AV_PIX_FMT_YUV420P;
    frame->width = width;
    frame->height = height;
    check(av_frame_get_buffer(frame.get(), 0));
  }

  void open_file() {
    AVFormatContext* opened = nullptr;
    check(avformat_alloc_output_context2(&opened, nullptr, "mp4", name.c_str()));
    format.reset(opened);
    format->flags |= AVFMT_FLAG_BITEXACT;
    AVStream* stream = avformat_new_stream(format.get(), nullptr);
    stream->time_base = kTick;
    check(avcodec_parameters_from_context(stream->codecpar, codec.get()));
    check(avio_open(&format->pb, name.c_str(), AVIO_FLAG_WRITE));
    check(av_opt_set(format->priv_data, "movflags", "faststart", 0));
    check(avformat_write_header(format.get(), nullptr));
  }

  /// Encodes a frame, or the remaining data if there is none, and writes the finished packets.
  void code(const AVFrame* image) {
    check(avcodec_send_frame(codec.get(), image));
    for (int code;
         (code = avcodec_receive_packet(codec.get(), packet.get())) != AVERROR(EAGAIN) && code != AVERROR_EOF;) {
      check(code);
      packet->stream_index = 0;
      packet->duration = ticks[written++];
      av_packet_rescale_ts(packet.get(), kTick, format->streams[0]->time_base);
      check(av_interleaved_write_frame(format.get(), packet.get()));
    }
  }
};

Mp4File::Mp4File(const std::filesystem::path& path, int width, int height) : parts_(std::make_unique<Parts>()) {
  av_log_set_level(AV_LOG_ERROR);
  parts_->name = path.string();
  parts_->open_codec(width, height);
  parts_->open_scale(width, height);
  parts_->packet.reset(av_packet_alloc());
  parts_->open_file();
}

Mp4File::~Mp4File() = default;

void Mp4File::add(const ByteImage& image, double seconds) {
  Parts& p = *parts_;
  assert(image.channels == 3 && image.width == p.codec->width && image.height == p.codec->height);
  p.check(av_frame_make_writable(p.frame.get()));
  const std::uint8_t* const pixels[] = {image.pixels.data()};
  const int row = 3 * image.width;
  sws_scale(p.scale.get(), pixels, &row, 0, image.height, p.frame->data, p.frame->linesize);
  // Times are rounded at both ends, so that errors do not add up.
  p.frame->pts = std::llround(p.shown_s / av_q2d(kTick));
  p.shown_s += seconds;
  p.ticks.push_back(std::max<std::int64_t>(1, std::llround(p.shown_s / av_q2d(kTick)) - p.frame->pts));
  p.code(p.frame.get());
}

void Mp4File::close() {
  parts_->code(nullptr);
  parts_->check(av_write_trailer(parts_->format.get()));
}

}  // namespace tacipc
