#include "common/simulation/furniture/catalogue.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "common/core/check.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation {
namespace {

struct Entry {
  std::string_view type;
  FurnitureModel (*build)(Random&);
};

/// Sorted by type.
constexpr std::array kEntries = {
    Entry{"armchair", &pieces::armchair},
    Entry{"backpack", &pieces::backpack},
    Entry{"big_plant", &pieces::big_plant},
    Entry{"book_row", &pieces::book_row},
    Entry{"book_stack", &pieces::book_stack},
    Entry{"bookshelf", &pieces::bookshelf},
    Entry{"bottle", &pieces::bottle},
    Entry{"cabinet", &pieces::cabinet},
    Entry{"cardboard_box", &pieces::cardboard_box},
    Entry{"cart", &pieces::cart},
    Entry{"clock", &pieces::clock},
    Entry{"coat_rack", &pieces::coat_rack},
    Entry{"coffee_table", &pieces::coffee_table},
    Entry{"couch", &pieces::couch},
    Entry{"cup", &pieces::cup},
    Entry{"curtain", &pieces::curtain},
    Entry{"desk", &pieces::desk},
    Entry{"desk_lamp", &pieces::desk_lamp},
    Entry{"dining_table", &pieces::dining_table},
    Entry{"door_leaf", &pieces::door_leaf},
    Entry{"drawer_unit", &pieces::drawer_unit},
    Entry{"fire_extinguisher", &pieces::fire_extinguisher},
    Entry{"floor_lamp", &pieces::floor_lamp},
    Entry{"fridge", &pieces::fridge},
    Entry{"keyboard", &pieces::keyboard},
    Entry{"laptop", &pieces::laptop},
    Entry{"microwave", &pieces::microwave},
    Entry{"monitor", &pieces::monitor},
    Entry{"mouse", &pieces::mouse},
    Entry{"newspaper", &pieces::newspaper},
    Entry{"notice_board", &pieces::notice_board},
    Entry{"office_chair", &pieces::office_chair},
    Entry{"pen_pot", &pieces::pen_pot},
    Entry{"poster", &pieces::poster},
    Entry{"potted_plant", &pieces::potted_plant},
    Entry{"printer", &pieces::printer},
    Entry{"radiator", &pieces::radiator},
    Entry{"round_table", &pieces::round_table},
    Entry{"rug", &pieces::rug},
    Entry{"sink_unit", &pieces::sink_unit},
    Entry{"suitcase", &pieces::suitcase},
    Entry{"vase", &pieces::vase},
    Entry{"wall_shelf", &pieces::wall_shelf},
    Entry{"wall_tv", &pieces::wall_tv},
    Entry{"waste_bin", &pieces::waste_bin},
    Entry{"water_cooler", &pieces::water_cooler},
    Entry{"whiteboard", &pieces::whiteboard},
    Entry{"wooden_chair", &pieces::wooden_chair},
};

Eigen::Vector2d half_size_of(const render::Mesh& mesh) {
  Eigen::Vector2f low = mesh.points.front().head<2>();
  Eigen::Vector2f high = low;
  for (const Eigen::Vector3f& point : mesh.points) {
    low = low.cwiseMin(point.head<2>());
    high = high.cwiseMax(point.head<2>());
  }
  return 0.5 * (high - low).cast<double>();
}

}  // namespace

std::vector<std::string> furniture_types() {
  std::vector<std::string> types;
  types.reserve(kEntries.size());
  for (const Entry& entry : kEntries) types.emplace_back(entry.type);
  return types;
}

FurnitureModel make_furniture(const std::string& type, std::uint64_t look) {
  const auto* const entry = std::find_if(kEntries.begin(), kEntries.end(),
                                         [&](const Entry& each) { return each.type == type; });
  TSG_CHECK(entry != kEntries.end());
  Random random(seed_of(look, type));
  FurnitureModel model = entry->build(random);
  model.half_size_m = half_size_of(model.mesh);
  return model;
}

}  // namespace tsg::simulation
