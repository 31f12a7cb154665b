#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/bus_config_file.hpp"
#include "services/segmentation/config.hpp"
#include "services/segmentation/node.hpp"
#include "services/segmentation/remote/relay_node.hpp"
#include "services/segmentation/remote/worker_node.hpp"

int main(int argc, char** argv) {
  using namespace tsg;
  return run_service(argc, argv,
                     {.name = "segmentation",
                      .description = "Instance masks of camera frames, recorded or by a network."},
                     [](const ServiceContext& context) {
                       const SegmentationConfig config = load_segmentation_config(context.config);
                       const BusConfig bus_config = load_bus_config(context.config);
                       if (context.check_config_only) return;
                       Bus bus(bus_config);
                       if (config.input == "network") {
                         RemoteWorkerNode(config, bus, context).run();
                       } else if (config.provider == "remote") {
                         RelayNode(config, bus, context).run();
                       } else {
                         SegmentationNode(config, bus, context).run();
                       }
                     });
}
