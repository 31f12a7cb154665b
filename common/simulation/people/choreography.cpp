#include "common/simulation/people/choreography.hpp"

#include <algorithm>
#include <utility>

#include "common/core/check.hpp"
#include "common/simulation/people/actor.hpp"
#include "common/simulation/people/body_mesh.hpp"
#include "common/simulation/people/check_actions.hpp"
#include "common/simulation/people/look.hpp"
#include "common/simulation/people/stage_props.hpp"
#include "common/simulation/people/timeline.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

/// How long somebody waits before asking again for what another has.
constexpr double kWaitAtLeastS = 0.2;

std::uint64_t look_of(const PersonDescription& person, std::uint64_t seed) {
  return person.look != 0 ? person.look : seed_of(seed, person.name);
}

/// Lets the next action of `actor` wait for a prop; false where it will never be free.
bool wait_for(std::size_t prop_index, std::vector<Actor>& actors, Actor& actor, PropStage& stage) {
  const PlannedProp& prop = stage.at(prop_index);
  if (prop.free_at_s != PlannedProp::kInUse) {
    actor.wait_until(prop.free_at_s);
    return true;
  }
  const Actor& user = actors.at(prop.used_by);
  if (user.is_done()) return false;
  actor.wait_until(std::max(user.now_s(), actor.now_s()) + kWaitAtLeastS);
  return true;
}

/// Plans action by action, always of the person who is free first, so that everybody finds props
/// where the others have left them by then.
Expected<void> plan_all(std::vector<Actor>& actors, PropStage& stage) {
  while (true) {
    Actor* first = nullptr;
    for (Actor& actor : actors) {
      if (!actor.is_done() && (first == nullptr || actor.now_s() < first->now_s())) first = &actor;
    }
    if (first == nullptr) return {};
    const std::optional<std::size_t> blocking = first->blocking_prop();
    if (!blocking) {
      first->plan_next_action();
    } else if (!wait_for(*blocking, actors, *first, stage)) {
      const PlannedProp& prop = stage.at(*blocking);
      return make_error(ExitCode::kBadData,
                        action_label(first->person(), first->next_action()) + " needs '" +
                            prop.name + "', which '" + actors.at(prop.used_by).person().name +
                            "' never leaves; use another object or let them stand up first");
    }
  }
}

}  // namespace

struct Choreography::Impl {
  std::vector<SkinnedMesh> bodies;
  std::vector<Timeline> timelines;
  std::vector<PlannedProp> props;

  [[nodiscard]] const PlannedProp& prop(const std::string& name) const {
    const auto found = std::find_if(props.begin(), props.end(), [&](const PlannedProp& candidate) {
      return candidate.name == name;
    });
    TSG_CHECK(found != props.end());
    return *found;
  }
};

Choreography::Choreography(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Choreography::Choreography(Choreography&&) noexcept = default;
Choreography& Choreography::operator=(Choreography&&) noexcept = default;
Choreography::~Choreography() = default;

Expected<Choreography> Choreography::plan(const std::vector<PersonDescription>& people,
                                          const std::map<std::string, Prop>& props,
                                          std::uint64_t seed) {
  if (auto checked = check_actions(people, props); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  PropStage stage(props);
  auto impl = std::make_unique<Impl>();
  std::vector<Actor> actors;
  actors.reserve(people.size());
  std::vector<Look> looks;
  for (const PersonDescription& person : people) {
    looks.push_back(make_look(look_of(person, seed)));
    const Look& look = looks.back();
    const Skeleton skeleton = make_skeleton(person.height_m, look.shoulder_width, look.hip_width);
    actors.emplace_back(
        Actor::Role{actors.size(), person, skeleton, seed_of(seed, "moves of " + person.name)},
        stage);
  }
  if (auto planned = plan_all(actors, stage); !planned) {
    return tl::unexpected<Error>(planned.error());
  }
  for (std::size_t i = 0; i < actors.size(); ++i) {
    impl->timelines.push_back(actors[i].take_timeline());
    impl->bodies.push_back(make_body(impl->timelines.back().skeleton(), looks[i]));
  }
  impl->props = stage.all();
  return Choreography(std::move(impl));
}

std::size_t Choreography::people() const { return impl_->timelines.size(); }

const render::Mesh& Choreography::mesh(std::size_t person) const {
  return impl_->bodies.at(person).rest;
}

void Choreography::pose(std::size_t person,
                        double time_s,
                        std::vector<Eigen::Vector3f>& points,
                        std::vector<Eigen::Vector3f>& normals) const {
  const Timeline& timeline = impl_->timelines.at(person);
  const Skeleton& skeleton = timeline.skeleton();
  deform(impl_->bodies.at(person), skeleton,
         {timeline.T_world_person(time_s), solve(skeleton, timeline.posture_at(time_s))}, points,
         normals);
}

std::vector<std::string> Choreography::moved_objects() const {
  std::vector<std::string> names;
  for (const PlannedProp& prop : impl_->props) {
    if (!prop.moves.empty()) names.push_back(prop.name);
  }
  return names;
}

SE3 Choreography::T_world_object(const std::string& object, double time_s) const {
  const PlannedProp& prop = impl_->prop(object);
  const auto next =
      std::upper_bound(prop.moves.begin(), prop.moves.end(), time_s,
                       [](double time, const PropMove& move) { return time < move.begin_s; });
  if (next == prop.moves.begin()) return prop.prop.T_world_object;
  const PropMove& move = *std::prev(next);
  return impl_->timelines.at(move.person).T_world_held(move.segment, std::min(time_s, move.end_s));
}

}  // namespace tsg::simulation
