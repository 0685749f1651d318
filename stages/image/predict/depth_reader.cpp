#include "stages/image/predict/depth_reader.h"

#include <onnx/onnx_pb.h>

#include <algorithm>
#include <opencv2/dnn.hpp>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sample/depth_model.h"

namespace tacipc {

struct DepthReader::Network {
  cv::dnn::Net net;
  int rows = 0, columns = 0;
};

namespace {

cv::Mat tensor_of(const ByteImage& image) {
  const int shape[] = {1, image.height, image.width, 3};
  cv::Mat tensor(4, shape, CV_32F);
  std::copy(image.pixels.begin(), image.pixels.end(), tensor.ptr<float>());
  return tensor;
}

}  // namespace

DepthReader::DepthReader(const std::filesystem::path& file) : network_(std::make_unique<Network>()) {
  const std::string bytes = read_file(file);
  // OpenCV does not say which size a network is for, and would answer for many others.
  onnx::ModelProto model;
  if (!model.ParseFromString(bytes) || model.producer_name() != DepthModel::producer || model.graph().input_size() != 2)
    throw DataError("{}: is not a network that depthnet wrote", file.string());
  const auto& shape = model.graph().input(0).type().tensor_type().shape();
  if (shape.dim_size() != 4) throw DataError("{}: is not a network that depthnet wrote", file.string());
  network_->rows = static_cast<int>(shape.dim(1).dim_value());
  network_->columns = static_cast<int>(shape.dim(2).dim_value());
  cv::setNumThreads(1);  // photographs are read side by side instead
  try {
    network_->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  } catch (const cv::Exception& error) {
    throw DataError("{}: OpenCV does not take it: {}", file.string(), error.err);
  }
}
DepthReader::~DepthReader() = default;
DepthReader::DepthReader(DepthReader&&) noexcept = default;

FloatImage DepthReader::depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw DataError("{}: has {} x {} pixels, its reference {} x {}", name, image.width, image.height, reference.width,
                    reference.height);
  if (image.width != network_->columns || image.height != network_->rows)
    throw DataError("{}: has {} x {} pixels; the network is for images of {} x {}", name, image.width, image.height,
                    network_->columns, network_->rows);
  FloatImage out(image.width, image.height, 1);
  try {
    network_->net.setInput(tensor_of(image), DepthModel::image);
    network_->net.setInput(tensor_of(reference), DepthModel::reference);
    const cv::Mat answer = network_->net.forward();
    if (answer.total() != out.pixels.size())
      throw DataError("{}: the network answers with {} numbers", name, answer.total());
    std::copy_n(answer.ptr<float>(), out.pixels.size(), out.pixels.begin());
  } catch (const cv::Exception& error) {
    throw DataError("{}: OpenCV: {}", name, error.err);
  }
  return out;
}

}  // namespace tacipc
