#include <opencv2/core/utility.hpp>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/bus_config_file.hpp"
#include "services/slam/config.hpp"
#include "services/slam/node.hpp"

int main(int argc, char** argv) {
  using namespace tsg;
  return run_service(
      argc, argv, {.name = "slam", .description = "Camera pose and keyframes from RGB-D frames."},
      [](const ServiceContext& context) {
        const SlamNodeConfig config = load_slam_config(context.config);
        const BusConfig bus_config = load_bus_config(context.config);
        if (context.check_config_only) return;
        // Tracking has one core and mapping the other: loops of a fraction of a millisecond that
        // OpenCV would share out among both cost more than they save.
        cv::setNumThreads(1);
        Bus bus(bus_config);
        SlamNode(config, bus, context).run();
      });
}
