#pragma once

#include <string>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/catalogue.hpp"

namespace tsg::simulation::pieces {

/// A piece that is neither sat on nor stood at: its class and its parts are all there is to it.
inline FurnitureModel thing(const std::string& class_name, const Assembly& parts) {
  FurnitureModel model;
  model.class_name = class_name;
  model.mesh = parts.finished();
  return model;
}

}  // namespace tsg::simulation::pieces
