#include "stages/image/predict/depth_reader.h"

#include <onnx/onnx_pb.h>

#include <algorithm>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sample/depth_model.h"

namespace tacipc {

struct DepthReader::Network {
  cv::dnn::Net net;
  int rows = 0, columns = 0;
};

namespace {

/// Whether a constant has the numbers that its shape asks for: OpenCV takes that on trust.
bool whole(const onnx::TensorProto& constant) {
  constexpr std::int64_t kMost = std::int64_t{1} << 28;
  std::int64_t count = 1;
  for (const std::int64_t size : constant.dims()) {
    if (size < 0 || size > kMost || (count *= size) > kMost) return false;
  }
  const auto has = [&](int listed, std::int64_t bytes_each) {
    return constant.has_raw_data()
               ? listed == 0 && static_cast<std::int64_t>(constant.raw_data().size()) == bytes_each * count
               : listed == count;
  };
  if (constant.data_location() != onnx::TensorProto::DEFAULT) return false;
  if (constant.data_type() == onnx::TensorProto::FLOAT) return has(constant.float_data_size(), 4);
  return constant.data_type() == onnx::TensorProto::INT64 && has(constant.int64_data_size(), 8);
}

/// Whether it is declared as these numbers, f32.
bool is(const onnx::ValueInfoProto& value, const char* name, const std::vector<std::int64_t>& shape) {
  const auto& type = value.type().tensor_type();
  return value.name() == name && type.elem_type() == onnx::TensorProto::FLOAT &&
         std::equal(shape.begin(), shape.end(), type.shape().dim().begin(), type.shape().dim().end(),
                    [](std::int64_t size, const auto& dimension) { return dimension.dim_value() == size; });
}

cv::Mat tensor_of(const ByteImage& image) {
  const int shape[] = {1, image.height, image.width, 3};
  cv::Mat tensor(4, shape, CV_32F);
  std::ranges::copy(image.pixels, tensor.ptr<float>());
  return tensor;
}

}  // namespace

DepthReader::DepthReader(const std::filesystem::path& file) : network_(std::make_unique<Network>()) {
  const DataError refused("{}: is damaged, or not a network that depthnet wrote", file.string());
  const std::string bytes = read_file(file);
  // OpenCV does not say which size a network is for, and would answer for many others.
  onnx::ModelProto model;
  if (!model.ParseFromString(bytes) || model.producer_name() != DepthModel::kProducer) throw refused;
  const onnx::GraphProto& graph = model.graph();
  if (graph.input_size() != 2 || graph.output_size() != 1) throw refused;
  const auto& shape = graph.input(0).type().tensor_type().shape();
  if (shape.dim_size() != 4) throw refused;
  const std::int64_t rows = shape.dim(1).dim_value(), columns = shape.dim(2).dim_value();
  constexpr std::int64_t kLargest = 1 << 15;
  if (rows < 1 || columns < 1 || rows > kLargest || columns > kLargest ||
      !is(graph.input(0), DepthModel::kImage, {1, rows, columns, 3}) ||
      !is(graph.input(1), DepthModel::kReference, {1, rows, columns, 3}) ||
      !is(graph.output(0), DepthModel::kIndentation, {1, 1, rows, columns}) ||
      !std::ranges::all_of(graph.initializer(), whole))
    throw refused;
  network_->rows = static_cast<int>(rows);
  network_->columns = static_cast<int>(columns);
  try {
    network_->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  } catch (const std::exception&) {
    throw refused;
  }
  for (const onnx::StringStringEntryProto& entry : model.metadata_props())
    if (entry.key() == DepthModel::kTrainedLook) look_ = TrainedLook::from_text(entry.value(), file.string());
}
DepthReader::~DepthReader() = default;
DepthReader::DepthReader(DepthReader&&) noexcept = default;

void DepthReader::check_size(const std::string& name, const ByteImage& image, const ByteImage& reference) const {
  if (image.width != reference.width || image.height != reference.height)
    throw DataError("{}: has {} x {} pixels, its reference {} x {}", name, image.width, image.height, reference.width,
                    reference.height);
  if (image.width != network_->columns || image.height != network_->rows)
    throw DataError("{}: has {} x {} pixels; the network is for images of {} x {}{}", name, image.width, image.height,
                    network_->columns, network_->rows,
                    image.width == network_->rows && image.height == network_->columns ? ": is it turned by 90°?" : "");
}

FloatImage DepthReader::depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) {
  check_size(name, image, reference);
  FloatImage out(image.width, image.height, 1);
  cv::Mat answer;
  try {
    network_->net.setInput(tensor_of(image), DepthModel::kImage);
    network_->net.setInput(tensor_of(reference), DepthModel::kReference);
    answer = network_->net.forward();
  } catch (const std::exception&) {
    throw DataError("{}: the network is damaged", name);
  }
  if (answer.type() != CV_32F || !answer.isContinuous() || answer.total() != out.pixels.size())
    throw DataError("{}: the network is damaged", name);
  std::copy_n(answer.ptr<float>(), out.pixels.size(), out.pixels.begin());
  return out;
}

void set_up_opencv() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);
}

}  // namespace tacipc
