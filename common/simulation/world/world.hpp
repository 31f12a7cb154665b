#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/render/lamp.hpp"
#include "common/render/layer.hpp"
#include "common/simulation/people/choreography.hpp"
#include "common/simulation/scene.hpp"
#include "common/simulation/simulator.hpp"
#include "common/simulation/world/placement.hpp"

namespace tsg::simulation {

/// The upright box around an object, along the object's own axes; world, metres.
struct ObjectBox {
  int id = 0;  ///< of its instance
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;  ///< of its x axis
};

/// The geometry of a scene and how it moves: what stays, the things that are moved, the people.
class World {
 public:
  /// kBadData names what in the scene does not fit.
  [[nodiscard]] static Expected<World> build(const SceneDescription& scene);

  [[nodiscard]] const std::vector<SimulatedInstance>& instances() const { return instances_; }
  /// The building and all things that stay, in world axes.
  [[nodiscard]] const std::vector<render::Part>& fixed() const { return fixed_; }
  [[nodiscard]] const std::vector<render::Lamp>& lamps() const { return lamps_; }
  /// Things that are moved, then people.
  [[nodiscard]] const std::vector<render::Part>& bodies() const { return bodies_; }

  /// World coordinates of a body's points and normals.
  void pose_body(std::size_t body,
                 double time_s,
                 std::vector<Eigen::Vector3f>& points,
                 std::vector<Eigen::Vector3f>& normals) const;

  /// Ids of what moves at a time, ascending. People always do: they breathe.
  [[nodiscard]] std::vector<int> moving(double time_s) const;

  /// Where an object of the scene is.
  [[nodiscard]] SE3 T_world_object(const std::string& name, double time_s) const;

  /// Where all objects of the scene are, by their ids.
  [[nodiscard]] std::vector<ObjectBox> object_boxes(double time_s) const;
  /// Whether the instance is a person; else it is an object.
  [[nodiscard]] bool is_person(int id) const;

 private:
  /// How an object comes to its place.
  struct Standing {
    std::string on;
    SE3 T_support_object;
    std::vector<RelocationDescription> relocations;  ///< by time
    std::vector<MoveDescription> moves;              ///< by time
    bool is_taken_by_people = false;
    [[nodiscard]] bool moves_itself() const {
      return is_taken_by_people || !relocations.empty() || !moves.empty();
    }
    /// Where it is at a time, where people leave it alone.
    [[nodiscard]] SE3 T_support_object_at(double time_s) const;
  };

  explicit World(Choreography choreography) : choreography_(std::move(choreography)) {}
  void add_object(const PlacedObject& object);
  void add_people(const std::vector<PersonDescription>& people);
  [[nodiscard]] int add_instance(const std::string& class_name,
                                 const std::string& name,
                                 bool is_dynamic);
  [[nodiscard]] bool is_moved(const std::string& name) const;
  [[nodiscard]] bool is_moving(const std::string& name, double time_s) const;

  Choreography choreography_;
  std::map<std::string, Standing> objects_;
  std::vector<SimulatedInstance> instances_;
  std::vector<Eigen::AlignedBox3f> shapes_;  ///< of the objects, in their own axes, by id
  std::vector<render::Part> fixed_;
  std::vector<render::Part> bodies_;
  std::vector<std::string> moved_;  ///< names of the first bodies
  std::vector<render::Lamp> lamps_;
};

}  // namespace tsg::simulation
