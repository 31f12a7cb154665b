#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

struct OnnxModelConfig {
  std::string file = {};             // the .onnx file
  std::string runtime_library = {};  // libonnxruntime.so; empty: where it was found at build time
  int threads = 2;                   // on two cores: the network takes 0.6 x the time of one thread
  std::string provider = "cpu";      // of the runtime: cpu, cuda or tensorrt
  bool provider_required = false;  // false: on the CPU, saying so, where the provider is not there

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// What a network is computed by.
struct ExecutionProvider {
  std::string name = "cpu";    ///< cpu, cuda or tensorrt
  std::string why_not_wanted;  ///< where it is another than was asked for: why, and the fix
};

/// A network in ONNX Runtime, which is loaded when the first model is. The only place that calls
/// the runtime; its exceptions end here. One owner; cancel() may come from any thread.
class OnnxModel {
 public:
  /// kMissingInput (no such file), kBadData (not an ONNX file or a damaged one), kUnsupportedModel
  /// (a network that the runtime does not run) or kUnavailable (no runtime, too old a one, or one
  /// without the provider that is required).
  static Expected<OnnxModel> load(const OnnxModelConfig& config);

  ~OnnxModel();
  OnnxModel(OnnxModel&& other) noexcept;
  OnnxModel& operator=(OnnxModel&& other) noexcept;
  OnnxModel(const OnnxModel&) = delete;
  OnnxModel& operator=(const OnnxModel&) = delete;

  [[nodiscard]] const ModelDescription& description() const;
  [[nodiscard]] const ExecutionProvider& execution_provider() const;

  /// Makes the memory of all tensors of fixed shape. kUnsupportedModel where an input is not
  /// float32 of fixed shape, or an output is neither float32 nor int64.
  Expected<void> allocate();

  /// The memory of an input; from allocate() on, as long as the model lives.
  [[nodiscard]] std::span<float> input(std::size_t index);

  /// The outputs of the last run(), valid until the next one; none where none succeeded.
  [[nodiscard]] std::span<const TensorView> outputs() const;

  /// Computes the outputs from the inputs. Fails where cancel() was called.
  Expected<void> run();

  /// Ends a running run() between two layers, and lets no other begin.
  void cancel();

 private:
  struct Impl;
  static Expected<OnnxModel> load_on_cpu(const OnnxModelConfig& config, const std::string& why_not);
  explicit OnnxModel(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg
