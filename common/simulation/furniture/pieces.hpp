#pragma once

#include "common/simulation/furniture/catalogue.hpp"
#include "common/simulation/random.hpp"

/// Every piece of the catalogue; each builds its model with the chance it is given. half_size_m is
/// set by make_furniture().
namespace tsg::simulation::pieces {

// tables.cpp
[[nodiscard]] FurnitureModel desk(Random& random);
[[nodiscard]] FurnitureModel dining_table(Random& random);
[[nodiscard]] FurnitureModel round_table(Random& random);
[[nodiscard]] FurnitureModel coffee_table(Random& random);

// chairs.cpp
[[nodiscard]] FurnitureModel office_chair(Random& random);
[[nodiscard]] FurnitureModel wooden_chair(Random& random);
// couches.cpp
[[nodiscard]] FurnitureModel armchair(Random& random);
[[nodiscard]] FurnitureModel couch(Random& random);

// books.cpp
[[nodiscard]] FurnitureModel bookshelf(Random& random);
[[nodiscard]] FurnitureModel book_row(Random& random);
[[nodiscard]] FurnitureModel book_stack(Random& random);
// storage.cpp
[[nodiscard]] FurnitureModel wall_shelf(Random& random);
[[nodiscard]] FurnitureModel cabinet(Random& random);
[[nodiscard]] FurnitureModel drawer_unit(Random& random);
[[nodiscard]] FurnitureModel cardboard_box(Random& random);

// screens.cpp
[[nodiscard]] FurnitureModel monitor(Random& random);
[[nodiscard]] FurnitureModel wall_tv(Random& random);
[[nodiscard]] FurnitureModel laptop(Random& random);
// desk_things.cpp
[[nodiscard]] FurnitureModel keyboard(Random& random);
[[nodiscard]] FurnitureModel mouse(Random& random);
[[nodiscard]] FurnitureModel cup(Random& random);
[[nodiscard]] FurnitureModel bottle(Random& random);
[[nodiscard]] FurnitureModel newspaper(Random& random);
[[nodiscard]] FurnitureModel pen_pot(Random& random);

// plants.cpp
[[nodiscard]] FurnitureModel vase(Random& random);
[[nodiscard]] FurnitureModel potted_plant(Random& random);
[[nodiscard]] FurnitureModel big_plant(Random& random);

// wall_things.cpp: origin at the bottom centre of their back
[[nodiscard]] FurnitureModel poster(Random& random);
[[nodiscard]] FurnitureModel whiteboard(Random& random);
[[nodiscard]] FurnitureModel clock(Random& random);
[[nodiscard]] FurnitureModel notice_board(Random& random);
[[nodiscard]] FurnitureModel curtain(Random& random);
[[nodiscard]] FurnitureModel radiator(Random& random);

// lamps.cpp
[[nodiscard]] FurnitureModel floor_lamp(Random& random);
[[nodiscard]] FurnitureModel desk_lamp(Random& random);

// bags.cpp
[[nodiscard]] FurnitureModel backpack(Random& random);
[[nodiscard]] FurnitureModel suitcase(Random& random);
[[nodiscard]] FurnitureModel rug(Random& random);
[[nodiscard]] FurnitureModel coat_rack(Random& random);

// office_things.cpp
[[nodiscard]] FurnitureModel waste_bin(Random& random);
[[nodiscard]] FurnitureModel fire_extinguisher(Random& random);
[[nodiscard]] FurnitureModel cart(Random& random);
[[nodiscard]] FurnitureModel printer(Random& random);
[[nodiscard]] FurnitureModel water_cooler(Random& random);

// doors.cpp: origin at the foot of the hinges, closed along +y
[[nodiscard]] FurnitureModel door_leaf(Random& random);

// kitchen.cpp
[[nodiscard]] FurnitureModel fridge(Random& random);
[[nodiscard]] FurnitureModel sink_unit(Random& random);
[[nodiscard]] FurnitureModel microwave(Random& random);

}  // namespace tsg::simulation::pieces
