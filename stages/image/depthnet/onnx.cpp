#include "stages/image/depthnet/onnx.h"

#include <fmt/core.h>
#include <onnx/onnx_pb.h>

#include <initializer_list>
#include <vector>

#include "common/sample/depth_model.h"
#include "stages/image/depthnet/unet.h"

namespace tacipc {
namespace {

constexpr int kOperatorSet = 11, kFormat = 6;  // ONNX 1.6, of 2019; OpenCV 4.6 and all later runtimes read it
constexpr int kRows = 2, kColumns = 3;         // axes

int up_to_multiple(int size, int of) { return (size + of - 1) / of * of; }

/// Each step gives a new tensor; `x_` is the last one's name.
class OnnxWriter : public NetworkWriter {
 public:
  OnnxWriter(const torch::jit::Module& module, const NetworkConfig& config, const ImageSize& size)
      : module_(module),
        reduction_(config.reduction),
        rows_(size.first),
        columns_(size.second),
        seen_rows_(up_to_multiple(rows_, reduction_) / reduction_),
        seen_columns_(up_to_multiple(columns_, reduction_) / reduction_) {
    model_.set_ir_version(kFormat);
    model_.set_producer_name(DepthModel::kProducer);
    model_.add_opset_import()->set_version(kOperatorSet);
    graph().set_name("depth_from_touch");
    for (const char* name : {DepthModel::kImage, DepthModel::kReference})
      declare(*graph().add_input(), name, {1, rows_, columns_, 3});
  }

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
  void convolution(int, int, int width, bool rectified) override {
    step("Conv", {x_, weights(weight_name(convolutions_)), weights(bias_name(convolutions_))});
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

  void keep_look(const TrainedLook& look) {
    onnx::StringStringEntryProto& entry = *model_.add_metadata_props();
    entry.set_key(DepthModel::kTrainedLook);
    entry.set_value(look.to_text());
  }
  std::string bytes() const { return model_.SerializeAsString(); }

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
  /// Of the last step.
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
  std::string weights(const std::string& name) {
    const torch::Tensor values = module_.attr(name).toTensor().detach().contiguous();
    onnx::TensorProto& tensor = constant(name, {});
    for (const std::int64_t size : values.sizes()) tensor.add_dims(size);
    tensor.set_data_type(onnx::TensorProto::FLOAT);
    tensor.set_raw_data(values.data_ptr<float>(), static_cast<std::size_t>(values.numel()) * sizeof(float));
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
  /// As Pad with the mode `edge` does, which OpenCV 4.6 does not know.
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

  const torch::jit::Module& module_;
  int reduction_, rows_, columns_, seen_rows_, seen_columns_, padded_rows_ = 0, padded_columns_ = 0;
  onnx::ModelProto model_;
  std::string x_;
  std::vector<std::string> kept_;
  int convolutions_ = 0;
};

}  // namespace

std::string onnx_of(const torch::jit::Module& module, const NetworkConfig& config, const ImageSize& size,
                    const TrainedLook* look) {
  OnnxWriter writer(module, config, size);
  write_unet(config, writer);
  if (look) writer.keep_look(*look);
  return writer.bytes();
}

}  // namespace tacipc
