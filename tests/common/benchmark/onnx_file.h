// Changes of an ONNX file whose digest is made right again, as who means harm would make it.
#pragma once

#include <onnx/onnx_pb.h>

#include <algorithm>
#include <functional>
#include <string>

#include "common/base/sha256.h"

namespace tacipc {

/// The digest is the last entry of the metadata, of the model without it.
inline std::string with_digest(onnx::ModelProto model) {
  auto& entries = *model.mutable_metadata_props();
  if (!entries.empty() && entries[entries.size() - 1].key() == "sha256") entries.RemoveLast();
  const std::string digest = sha256(model.SerializeAsString());
  onnx::StringStringEntryProto& entry = *model.add_metadata_props();
  entry.set_key("sha256");
  entry.set_value(digest);
  return model.SerializeAsString();
}

/// \pre the bytes are a model
inline std::string changed_onnx(const std::string& bytes, const std::function<void(onnx::ModelProto&)>& change) {
  onnx::ModelProto model;
  model.ParseFromString(bytes);
  change(model);
  return with_digest(model);
}

/// The constant of this name. \pre there is one
inline onnx::TensorProto& constant_of(onnx::ModelProto& model, const std::string& name) {
  auto& constants = *model.mutable_graph()->mutable_initializer();
  return *std::find_if(constants.begin(), constants.end(),
                       [&](const auto& constant) { return constant.name() == name; });
}

}  // namespace tacipc
