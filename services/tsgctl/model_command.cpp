#include "services/tsgctl/model_command.hpp"

#include <cstdint>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/core/time.hpp"
#include "services/tsgctl/model/model_check.hpp"
#include "services/tsgctl/model/model_run.hpp"
#include "services/tsgctl/run/progress.hpp"

namespace tsg {
namespace {

struct CheckOptions {
  ModelProviderConfig provider;
  bool json = false;
};

constexpr const char* kCheckFooter = R"(
Loads the network as the segmentation service does, and runs it twice on noise.

Examples:
  tsgctl model check solov2.onnx
  tsgctl model check rtmdet-ins.onnx --labels coco.txt
  tsgctl model check yolo11n-seg.onnx --json | jq .network_ms
Which layouts are supported and how to export them: docs/models.md.
Ends with 65 where a file is damaged or the labels are not those of the network, 66 where it is not
there, 67 where the labels file is empty, 72 where the network gives NaN, 76 where its layout is
unknown.)";

constexpr const char* kModelRunFooter = R"(
Runs the network over images as the segmentation service does, and writes what it finds: OUT/mask has a
label image for each (0 = none, i + 1 = its instance i), OUT/found.json each instance's class, score
and box, OUT/picture, with --pictures, what it looks like.

Examples:
  tsgctl model run net.onnx --input photographs --out found --pictures
  tsgctl model run net.onnx --input data/walking --out found --score 0.5
Ends as `tsgctl model check` does; with 66 where there is no such folder, 67 where no image is in it,
65 where an image is damaged.)";

void check(const CheckOptions& options) {
  const ModelCheck checked = value_or_throw(check_model(options.provider));
  std::cout << (options.json ? to_json(checked).dump(2) + "\n" : to_text(checked));
}

void run(const ModelRun& options) {
  Progress progress;
  const std::int64_t start_ns = monotonic_ns();
  const auto show = [&](int done, int all) {
    progress.update({static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(all), "looking",
                     to_seconds(monotonic_ns() - start_ns)});
  };
  throw_on_error(run_model(options, show));
}

void add_provider_options(CLI::App& command, ModelProviderConfig& provider) {
  command.add_option("FILE", provider.model.file, "In ONNX format")->required();
  command
      .add_option("--labels", provider.labels_file,
                  "Class names, one on each line; default: those in FILE")
      ->type_name("FILE");
  command.add_option("--threads", provider.model.threads, "Of the network")
      ->check(CLI::Range(1, 64).description(""))
      ->capture_default_str();
}

void add_check(CLI::App& model) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App& command =
      *model.add_subcommand("check", "Tell whether segmentation can run a network, and how");
  add_provider_options(command, options->provider);
  command.add_flag("--json", options->json, "For scripts");
  command.footer(kCheckFooter);
  command.callback([options] { check(*options); });
}

void add_run(CLI::App& model) {
  const auto options = std::make_shared<ModelRun>();
  CLI::App& command = *model.add_subcommand("run", "Find the instances in a folder of images");
  add_provider_options(command, options->provider);
  command.add_option("--input", options->input, "Folder with images, or a sequence")
      ->type_name("DIR")
      ->required();
  command.add_option("--out", options->out, "Folder for what is found")
      ->type_name("DIR")
      ->required();
  command.add_option("--score", options->provider.decoder.score_threshold, "Drop what is below it")
      ->check(CLI::Range(0.0, 1.0).description(""))
      ->capture_default_str();
  command.add_flag("--pictures", options->pictures, "Draw what is found");
  command.footer(kModelRunFooter);
  command.callback([options] { run(*options); });
}

}  // namespace

void add_model_command(CLI::App& app) {
  CLI::App& model = *app.add_subcommand("model", "Examine networks for segmentation");
  model.footer(kCheckFooter);
  model.require_subcommand(1);
  add_check(model);
  add_run(model);
}

}  // namespace tsg
