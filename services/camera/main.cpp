#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/bus_config_file.hpp"
#include "services/camera/config.hpp"
#include "services/camera/node.hpp"
#include "services/camera/open_source.hpp"

int main(int argc, char** argv) {
  using namespace tsg;
  return run_service(
      argc, argv,
      {.name = "camera", .description = "RGB-D frames from a recording or a simulated room."},
      [](const ServiceContext& context) {
        const CameraConfig config = load_camera_config(context.config);
        const BusConfig bus_config = load_bus_config(context.config);
        if (context.check_config_only) return;
        auto source = open_source(config);
        Bus bus(bus_config);
        CameraNode(config, bus, context, std::move(source)).run();
      });
}
