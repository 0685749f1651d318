#include "stages/image/predict/depth_reader.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <utility>

#include "common/base/error.h"

namespace tacipc {

struct DepthReader::Network {
  DepthModel size;  // without weights
  cv::dnn::Net net;
};

namespace {

cv::Mat tensor_of(const ByteImage& image) {
  const int shape[] = {1, image.height, image.width, 3};
  cv::Mat tensor(4, shape, CV_32F);
  std::ranges::copy(image.pixels, tensor.ptr<float>());
  return tensor;
}

/// Rethrows an exception of OpenCV as an error of TacIPC.
[[noreturn]] void refuse(const cv::Exception& error, const std::string& model_name) {
  if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
  throw DataError("{}: OpenCV cannot compute it: {}", model_name, error.err);
}

}  // namespace

DepthReader::DepthReader(const DepthModel& model, std::string model_name)
    : network_(std::make_unique<Network>()), model_name_(std::move(model_name)) {
  network_->size = {
      .network = model.network, .rows = model.rows, .columns = model.columns, .convolutions = {}, .look = {}};
  const std::string bytes = model.to_onnx();
  try {
    network_->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  } catch (const cv::Exception& error) {
    refuse(error, model_name_);
  }
}
DepthReader::~DepthReader() = default;
DepthReader::DepthReader(DepthReader&&) noexcept = default;

FloatImage DepthReader::depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) {
  check_size(network_->size, name, image, reference);
  FloatImage out(image.width, image.height, 1);
  cv::Mat answer;
  try {
    network_->net.setInput(tensor_of(image), DepthModel::kImage);
    network_->net.setInput(tensor_of(reference), DepthModel::kReference);
    answer = network_->net.forward();
  } catch (const cv::Exception& error) {
    refuse(error, model_name_);
  }
  if (answer.type() != CV_32F || !answer.isContinuous() || answer.total() != out.pixels.size())
    throw DataError("{}: {}: OpenCV answers with {} numbers", model_name_, name, answer.total());
  std::copy_n(answer.ptr<float>(), out.pixels.size(), out.pixels.begin());
  if (!std::ranges::all_of(out.pixels, [](float depth) { return std::isfinite(depth); }))
    throw DataError("{}: is damaged: its depth of {} is not finite", model_name_, name);
  return out;
}

void check_size(const DepthModel& model, const std::string& name, const ByteImage& image, const ByteImage& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw DataError("{}: has {} x {} pixels, its reference {} x {}", name, image.width, image.height, reference.width,
                    reference.height);
  if (image.width != model.columns || image.height != model.rows)
    throw DataError("{}: has {} x {} pixels; the network is for images of {} x {}{}", name, image.width, image.height,
                    model.columns, model.rows,
                    image.width == model.rows && image.height == model.columns ? ": is it turned by 90°?" : "");
}

void set_up_opencv() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);
}

}  // namespace tacipc
