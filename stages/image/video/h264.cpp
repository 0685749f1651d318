#include "stages/image/video/h264.h"

#include <wels/codec_api.h>

#include <cstring>

#include "common/base/error.h"
#include "stages/image/video/yuv.h"

namespace tacipc {
namespace {

/// Fine enough that the shading of a light touch stays: a mean error of a code or two.
constexpr int kQuantiser = 20;
constexpr unsigned kKeyEvery = 50;     // frames: where players may jump to
constexpr float kNominalRate = 25.0F;  // the encoder wants one; the file says when frames are shown

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

SEncParamExt settings(ISVCEncoder& encoder, int width, int height) {
  SEncParamExt p;
  encoder.GetDefaultParams(&p);
  p.iUsageType = CAMERA_VIDEO_REAL_TIME;
  p.iPicWidth = width;
  p.iPicHeight = height;
  p.fMaxFrameRate = kNominalRate;
  p.iRCMode = RC_OFF_MODE;
  p.iMinQp = p.iMaxQp = kQuantiser;
  p.uiIntraPeriod = kKeyEvery;
  p.eSpsPpsIdStrategy = CONSTANT_ID;  // the file has one set of parameters for all key frames
  p.iMultipleThreadIdc = 1;
  p.iEntropyCodingModeFlag = 1;
  p.iComplexityMode = HIGH_COMPLEXITY;
  // What would drop frames or change their quality.
  p.bEnableFrameSkip = p.bEnableDenoise = p.bEnableBackgroundDetection = p.bEnableAdaptiveQuant = false;
  p.bEnableSceneChangeDetect = p.bEnableLongTermReference = false;
  p.iSpatialLayerNum = p.iTemporalLayerNum = 1;
  SSpatialLayerConfig& layer = p.sSpatialLayers[0];
  layer.iVideoWidth = width;
  layer.iVideoHeight = height;
  layer.fFrameRate = kNominalRate;
  layer.iDLayerQp = kQuantiser;
  layer.uiProfileIdc = PRO_HIGH;
  layer.sSliceArgument.uiSliceMode = SM_SINGLE_SLICE;
  layer.bVideoSignalTypePresent = layer.bColorDescriptionPresent = true;
  layer.uiVideoFormat = VF_UNDEF;
  layer.bFullRange = false;
  layer.uiColorPrimaries = CP_BT709;
  layer.uiTransferCharacteristics = TRC_BT709;
  layer.uiColorMatrix = CM_BT709;
  return p;
}

}  // namespace

struct H264Encoder::Codec {
  ISVCEncoder* encoder = nullptr;
  int width = 0, height = 0;

  ~Codec() {
    if (encoder == nullptr) return;
    encoder->Uninitialize();
    WelsDestroySVCEncoder(encoder);
  }
};

H264Encoder::H264Encoder(int width, int height) : codec_(std::make_unique<Codec>()) {
  codec_->width = width;
  codec_->height = height;
  if (WelsCreateSVCEncoder(&codec_->encoder) != 0 || codec_->encoder == nullptr)
    throw DataError("OpenH264 has no encoder");
  int quiet = WELS_LOG_QUIET, planes = videoFormatI420;
  codec_->encoder->SetOption(ENCODER_OPTION_TRACE_LEVEL, &quiet);
  const SEncParamExt p = settings(*codec_->encoder, width, height);
  if (codec_->encoder->InitializeExt(&p) != cmResultSuccess)
    throw DataError("OpenH264 does not code frames of {} x {} pixels", width, height);
  codec_->encoder->SetOption(ENCODER_OPTION_DATAFORMAT, &planes);
}

H264Encoder::~H264Encoder() = default;

CodedFrame H264Encoder::encode(const ByteImage& image) {
  YuvImage yuv = yuv_of(image);
  SSourcePicture source{};
  source.iColorFormat = videoFormatI420;
  source.iPicWidth = image.width;
  source.iPicHeight = image.height;
  source.iStride[0] = image.width;
  source.iStride[1] = source.iStride[2] = image.width / 2;
  source.pData[0] = yuv.y.data();
  source.pData[1] = yuv.cb.data();
  source.pData[2] = yuv.cr.data();
  SFrameBSInfo info{};
  const int failed = codec_->encoder->EncodeFrame(&source, &info);
  if (failed != cmResultSuccess || info.eFrameType == videoFrameTypeSkip || info.eFrameType == videoFrameTypeInvalid)
    throw DataError("OpenH264 does not code a frame of {} x {} pixels (code {})", image.width, image.height, failed);
  CodedFrame frame{.bytes = {}, .key = info.eFrameType == videoFrameTypeIDR};
  for (int l = 0; l < info.iLayerNum; ++l) {
    const SLayerBSInfo& layer = info.sLayerInfo[l];
    const unsigned char* at = layer.pBsBuf;
    for (int n = 0; n < layer.iNalCount; at += layer.pNalLengthInByte[n++]) {
      const std::size_t start_code = at[2] == 1 ? 3 : 4;  // 00 00 01 or 00 00 00 01
      const std::string unit(reinterpret_cast<const char*>(at) + start_code,
                             static_cast<std::size_t>(layer.pNalLengthInByte[n]) - start_code);
      const int kind = unit[0] & 0x1f;
      if (kind != NAL_SPS && kind != NAL_PPS) {
        frame.bytes += big_endian(unit.size()) + unit;
        continue;
      }
      std::string& parameters = kind == NAL_SPS ? sequence_ : picture_;
      if (!parameters.empty() && parameters != unit)
        throw DataError("OpenH264 has changed the parameters of its stream");
      parameters = unit;
    }
  }
  return frame;
}

}  // namespace tacipc
