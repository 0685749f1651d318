#include "common/benchmark/depth_model.h"

#include <fmt/core.h>
#include <onnx/onnx_pb.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/sha256.h"

namespace tacipc {
namespace {

constexpr const char* kProducer = "tacipc depthnet";
constexpr int kOperatorSet = 11, kFormat = 6;  // ONNX 1.6 (2019), which OpenCV 4.6 and all later runtimes read
constexpr int kRows = 2, kColumns = 3;         // indices of axes
constexpr std::int64_t kLargestSide = 1 << 15;
constexpr std::uintmax_t kLargestFile = (std::uintmax_t{1} << 31) - 1;  // bytes: limit of protobuf
// Metadata: statistics of the training images; SHA-256 of the model without this entry, which is the last one.
constexpr const char *kTrainedLook = "trained_look", *kSha256 = "sha256";

int up_to_multiple(int size, int of) { return (size + of - 1) / of * of; }

/// Writes the network as a graph: its weights have shapes but no numbers. Each step makes a new tensor; `x_` is the
/// name of the last one.
class GraphWriter : public NetworkWriter {
 public:
  GraphWriter(const NetworkConfig& config, int rows, int columns)
      : reduction_(config.reduction),
        rows_(rows),
        columns_(columns),
        seen_rows_(up_to_multiple(rows_, reduction_) / reduction_),
        seen_columns_(up_to_multiple(columns_, reduction_) / reduction_) {
    model_.set_ir_version(kFormat);
    model_.set_producer_name(kProducer);
    model_.add_opset_import()->set_version(kOperatorSet);
    graph().set_name("depth_from_touch");
    for (const char* name : {DepthModel::kImage, DepthModel::kReference})
      declare(*graph().add_input(), name, {1, rows_, columns_, 3});
    write_unet(config, *this);
  }
  onnx::ModelProto take() { return std::move(model_); }

  void begin(double change_codes, double reference_codes, int multiple) override {
    const std::string image = channels_first(DepthModel::kImage), reference = channels_first(DepthModel::kReference);
    step("Concat", {step("Sub", {image, reference}), reference});
    attribute("axis", 1);
    if (reduction_ > 1) {
      step("AveragePool", {x_});
      attribute("kernel_shape", {reduction_, reduction_});
      attribute("strides", {reduction_, reduction_});
      attribute("ceil_mode", 1);
      attribute("count_include_pad", 0);
    }
    const auto change = static_cast<float>(1.0 / change_codes), level = static_cast<float>(1.0 / reference_codes);
    step("Mul", {x_, numbers("scales", {1, 6, 1, 1}, {change, change, change, level, level, level})});
    step("Add", {x_, numbers("offsets", {1, 6, 1, 1}, {0, 0, 0, -1, -1, -1})});
    padded_rows_ = up_to_multiple(seen_rows_, multiple);
    padded_columns_ = up_to_multiple(seen_columns_, multiple);
    repeat_last(kRows, seen_rows_, padded_rows_);
    repeat_last(kColumns, seen_columns_, padded_columns_);
  }
  void convolution(int in, int out, int width, bool rectified) override {
    step("Conv",
         {x_, weights(weight_name(convolutions_), {out, in, width, width}), weights(bias_name(convolutions_), {out})});
    attribute("kernel_shape", {width, width});
    attribute("pads", {width / 2, width / 2, width / 2, width / 2});
    ++convolutions_;
    if (rectified) step("Relu", {x_});
  }
  void halve() override {
    step("MaxPool", {x_});
    attribute("kernel_shape", {2, 2});
    attribute("strides", {2, 2});
  }
  void keep(int level) override {
    kept_.resize(static_cast<std::size_t>(level) + 1);
    kept_.back() = x_;
  }
  void enlarge_and_join(int level) override {
    enlarge(2);
    step("Concat", {kept_[level], x_});
    attribute("axis", 1);
  }
  void end() override {
    keep_first(kRows, padded_rows_, seen_rows_);
    keep_first(kColumns, padded_columns_, seen_columns_);
    if (reduction_ > 1) enlarge(reduction_);
    keep_first(kRows, reduction_ * seen_rows_, rows_);
    keep_first(kColumns, reduction_ * seen_columns_, columns_);
    graph().mutable_node(graph().node_size() - 1)->set_output(0, DepthModel::kIndentation);
    declare(*graph().add_output(), DepthModel::kIndentation, {1, 1, rows_, columns_});
  }

 private:
  onnx::GraphProto& graph() { return *model_.mutable_graph(); }

  static void declare(onnx::ValueInfoProto& value, const std::string& name, std::initializer_list<int> shape) {
    value.set_name(name);
    auto* type = value.mutable_type()->mutable_tensor_type();
    type->set_elem_type(onnx::TensorProto::FLOAT);
    for (const int size : shape) type->mutable_shape()->add_dim()->set_dim_value(size);
  }

  std::string step(const char* type, std::initializer_list<std::string> inputs) {
    onnx::NodeProto& node = *graph().add_node();
    node.set_op_type(type);
    for (const std::string& input : inputs) node.add_input(input);
    x_ = fmt::format("x{}", graph().node_size());
    node.set_name(x_);
    node.add_output(x_);
    return x_;
  }
  /// Adds an attribute to the last step.
  onnx::AttributeProto& attribute(const char* name) {
    onnx::AttributeProto& added = *graph().mutable_node(graph().node_size() - 1)->add_attribute();
    added.set_name(name);
    return added;
  }
  void attribute(const char* name, int value) {
    onnx::AttributeProto& added = attribute(name);
    added.set_type(onnx::AttributeProto::INT);
    added.set_i(value);
  }
  void attribute(const char* name, const char* value) {
    onnx::AttributeProto& added = attribute(name);
    added.set_type(onnx::AttributeProto::STRING);
    added.set_s(value);
  }
  void attribute(const char* name, std::initializer_list<int> values) {
    onnx::AttributeProto& added = attribute(name);
    added.set_type(onnx::AttributeProto::INTS);
    for (const int value : values) added.add_ints(value);
  }

  onnx::TensorProto& constant(const std::string& name, std::initializer_list<std::int64_t> shape) {
    onnx::TensorProto& tensor = *graph().add_initializer();
    tensor.set_name(name);
    for (const std::int64_t size : shape) tensor.add_dims(size);
    return tensor;
  }
  std::string numbers(const std::string& name, std::initializer_list<std::int64_t> shape,
                      std::initializer_list<float> values) {
    onnx::TensorProto& tensor = constant(name, shape);
    tensor.set_data_type(onnx::TensorProto::FLOAT);
    for (const float value : values) tensor.add_float_data(value);
    return name;
  }
  std::string whole_number(const std::string& name, int value) {
    onnx::TensorProto& tensor = constant(name, {1});
    tensor.set_data_type(onnx::TensorProto::INT64);
    tensor.add_int64_data(value);
    return name;
  }
  std::string weights(const std::string& name, std::initializer_list<std::int64_t> shape) {
    constant(name, shape).set_data_type(onnx::TensorProto::FLOAT);
    return name;
  }

  std::string channels_first(const char* name) {
    step("Transpose", {name});
    attribute("perm", {0, 3, 1, 2});
    return x_;
  }
  void slice(int axis, int begin, int end) {
    const std::string name = fmt::format("slice{}", graph().node_size() + 1);
    step("Slice", {x_, whole_number(name + "_begin", begin), whole_number(name + "_end", end),
                   whole_number(name + "_axis", axis)});
  }
  void keep_first(int axis, int size, int wanted) {
    if (wanted < size) slice(axis, 0, wanted);
  }
  /// Repeats the last row or column like Pad with mode `edge`, which OpenCV 4.6 does not support.
  void repeat_last(int axis, int size, int wanted) {
    if (wanted == size) return;
    const std::string all = x_;
    slice(axis, size - 1, size);
    const std::string last = x_;
    step("Concat", {all});
    for (int i = size; i < wanted; ++i) graph().mutable_node(graph().node_size() - 1)->add_input(last);
    attribute("axis", axis);
  }
  void enlarge(int factor) {
    const std::string name = fmt::format("enlarge{}", graph().node_size() + 1);
    const auto by = static_cast<float>(factor);
    const std::string none = numbers(name + "_region", {0}, {});
    step("Resize", {x_, none, numbers(name + "_by", {4}, {1, 1, by, by})});
    attribute("mode", "linear");
    attribute("coordinate_transformation_mode", "half_pixel");
  }

  int reduction_, rows_, columns_, seen_rows_, seen_columns_, padded_rows_ = 0, padded_columns_ = 0;
  onnx::ModelProto model_;
  std::string x_;
  std::vector<std::string> kept_;
  int convolutions_ = 0;
};

/// Returns whether a constant of the graph is a convolution's weights; only their names begin with w.
bool is_weights(const onnx::TensorProto& constant) { return constant.name().starts_with('w'); }

void add_metadata(onnx::ModelProto& model, const char* key, const std::string& value) {
  onnx::StringStringEntryProto& entry = *model.add_metadata_props();
  entry.set_key(key);
  entry.set_value(value);
}

/// Removes and returns the last entry of the metadata, if it has this key.
std::optional<std::string> take_metadata(onnx::ModelProto& model, const char* key) {
  const int last = model.metadata_props_size() - 1;
  if (last < 0 || model.metadata_props(last).key() != key) return std::nullopt;
  std::string value = model.metadata_props(last).value();
  model.mutable_metadata_props()->RemoveLast();
  return value;
}

/// Returns the network whose graph this may be; nothing if there is no such network.
std::optional<DepthModel> plan_of(const onnx::GraphProto& graph) {
  std::int64_t channels = 0, convolutions = 0, reduction = 1;
  for (const onnx::TensorProto& constant : graph.initializer()) {
    if (constant.name() != weight_name(static_cast<int>(convolutions))) continue;
    if (convolutions == 0 && constant.dims_size() == 4) channels = constant.dims(0);
    ++convolutions;
  }
  for (const onnx::NodeProto& node : graph.node())
    if (node.op_type() == "AveragePool" && node.attribute_size() > 0 && node.attribute(0).ints_size() > 0)
      reduction = node.attribute(0).ints(0);
  if (graph.input_size() == 0) return std::nullopt;
  const auto& shape = graph.input(0).type().tensor_type().shape();
  if (shape.dim_size() != 4) return std::nullopt;
  const std::int64_t rows = shape.dim(1).dim_value(), columns = shape.dim(2).dim_value();
  constexpr int kOfNoLevel = 3, kOfALevel = 4;
  const std::int64_t levels = (convolutions - kOfNoLevel) / kOfALevel;
  const auto fits = [](std::int64_t number, std::int64_t most) { return number >= 1 && number <= most; };
  if (!fits(levels, NetworkConfig::kMostLevels) || !fits(channels, NetworkConfig::kMostChannels) ||
      !fits(reduction, NetworkConfig::kMostReduction) || !fits(rows, kLargestSide) || !fits(columns, kLargestSide))
    return std::nullopt;
  return DepthModel{.network = {.levels = static_cast<int>(levels),
                                .base_channels = static_cast<int>(channels),
                                .reduction = static_cast<int>(reduction)},
                    .rows = static_cast<int>(rows),
                    .columns = static_cast<int>(columns),
                    .convolutions = {},
                    .look = {}};
}

/// Moves the weights' numbers out of the graph, in its order.
std::vector<std::string> take_weights(onnx::GraphProto& graph) {
  std::vector<std::string> numbers;
  for (onnx::TensorProto& constant : *graph.mutable_initializer()) {
    if (!is_weights(constant)) continue;
    numbers.push_back(std::move(*constant.mutable_raw_data()));
    constant.clear_raw_data();
  }
  return numbers;
}

std::size_t count_of(const onnx::TensorProto& constant) {
  std::size_t count = 1;
  for (const std::int64_t size : constant.dims()) count *= static_cast<std::size_t>(size);
  return count;
}

}  // namespace

std::string DepthModel::to_onnx() const {
  onnx::ModelProto model = GraphWriter(network, rows, columns).take();
  std::size_t next = 0;
  for (onnx::TensorProto& constant : *model.mutable_graph()->mutable_initializer()) {
    if (!is_weights(constant)) continue;
    const Convolution& convolution = convolutions.at(next / 2);
    const std::vector<float>& numbers = next % 2 == 0 ? convolution.weights : convolution.biases;
    assert(numbers.size() == count_of(constant));
    constant.set_raw_data(numbers.data(), numbers.size() * sizeof(float));
    ++next;
  }
  assert(next == 2 * convolutions.size());
  if (look) add_metadata(model, kTrainedLook, look->to_text());
  add_metadata(model, kSha256, sha256(model.SerializeAsString()));
  return model.SerializeAsString();
}

DepthModel DepthModel::from_onnx(const std::string& bytes, const std::string& name) {
  const DataError refused("{}: is damaged, or not a network that depthnet wrote", name);
  onnx::ModelProto file;
  if (!file.ParseFromString(bytes) || file.producer_name() != kProducer) throw refused;
  // Files of earlier versions have no digest.
  if (const auto digest = take_metadata(file, kSha256); digest && *digest != sha256(file.SerializeAsString()))
    throw refused;
  const auto look_text = take_metadata(file, kTrainedLook);
  auto model = plan_of(file.graph());
  if (!model) throw refused;
  const std::vector<std::string> numbers = take_weights(*file.mutable_graph());
  const onnx::ModelProto ours = GraphWriter(model->network, model->rows, model->columns).take();
  if (file.SerializeAsString() != ours.SerializeAsString()) throw refused;
  std::size_t next = 0;
  for (const onnx::TensorProto& constant : ours.graph().initializer()) {
    if (!is_weights(constant)) continue;
    const std::string& raw = numbers[next];
    const std::size_t count = count_of(constant);
    if (raw.size() != count * sizeof(float)) throw refused;
    std::vector<float> values(count);
    std::memcpy(values.data(), raw.data(), raw.size());
    if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
      throw DataError("{}: is damaged: a weight of {} is not finite", name, constant.name());
    if (next % 2 == 0)
      model->convolutions.push_back({.weights = std::move(values), .biases = {}});
    else
      model->convolutions.back().biases = std::move(values);
    ++next;
  }
  if (look_text) {
    model->look = TrainedLook::from_text(*look_text, name);
    if (model->look->reduction() != model->network.reduction) throw refused;
  }
  return *std::move(model);
}

DepthModel read_depth_model(const std::filesystem::path& file) {
  std::error_code error;
  if (const auto size = std::filesystem::file_size(file, error); !error && size > kLargestFile)
    throw DataError("{}: has {} bytes; no network that depthnet writes has more than {}", file.string(), size,
                    kLargestFile);
  const std::string bytes = read_file(file);
  if (bytes.starts_with("PK"))
    throw DataError(
        "{}: is a program (TorchScript), which may do anything, and is not run: give model_<width>x<height>.onnx, "
        "which depthnet writes beside it of each network that reads depth",
        file.string());
  return DepthModel::from_onnx(bytes, file.string());
}

}  // namespace tacipc
