#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/bus_config_file.hpp"
#include "services/map_server/config.hpp"
#include "services/map_server/node.hpp"

int main(int argc, char** argv) {
  using namespace tsg;
  return run_service(
      argc, argv,
      {.name = "map_server", .description = "Coloured cloud and semantic octree from keyframes."},
      [](const ServiceContext& context) {
        const MapServerConfig config = load_map_server_config(context.config);
        const BusConfig bus_config = load_bus_config(context.config);
        if (context.check_config_only) return;
        Bus bus(bus_config);
        MapServerNode(config, bus, context).run();
      });
}
