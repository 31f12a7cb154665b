#include "services/tsgctl/model_command.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "services/tsgctl/model/model_check.hpp"

namespace tsg {
namespace {

struct ModelOptions {
  ModelProviderConfig provider;
  bool json = false;
};

constexpr const char* kFooter = R"(
Loads the network as the segmentation service does, and runs it twice on noise.

Examples:
  tsgctl model check solov2.onnx
  tsgctl model check rtmdet-ins.onnx --labels coco.txt
  tsgctl model check yolo11n-seg.onnx --json | jq .network_ms
Which layouts are supported and how to export them: docs/models.md.
Ends with 65 where a file is damaged or the labels are not those of the network, 66 where it is not
there, 67 where the labels file is empty, 72 where the network gives NaN, 76 where its layout is
unknown.)";

void check(const ModelOptions& options) {
  const ModelCheck checked = value_or_throw(check_model(options.provider));
  std::cout << (options.json ? to_json(checked).dump(2) + "\n" : to_text(checked));
}

}  // namespace

void add_model_command(CLI::App& app) {
  CLI::App& model = *app.add_subcommand("model", "Examine networks for segmentation");
  model.footer(kFooter);
  model.require_subcommand(1);
  const auto options = std::make_shared<ModelOptions>();
  CLI::App& checking =
      *model.add_subcommand("check", "Tell whether segmentation can run a network, and how");
  checking.add_option("FILE", options->provider.model.file, "In ONNX format")->required();
  checking
      .add_option("--labels", options->provider.labels_file,
                  "Class names, one on each line; default: those in FILE")
      ->type_name("FILE");
  checking.add_option("--threads", options->provider.model.threads, "Of the network")
      ->check(CLI::Range(1, 64).description(""))
      ->capture_default_str();
  checking.add_flag("--json", options->json, "For scripts");
  checking.footer(kFooter);
  checking.callback([options] { check(*options); });
}

}  // namespace tsg
