#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/simulation/people/choreography.hpp"

namespace tsg::simulation {

/// What can be said of all actions without planning them. kBadData names the person, the action
/// (counted from 1) and what is wrong.
[[nodiscard]] Expected<void> check_actions(const std::vector<PersonDescription>& people,
                                           const std::map<std::string, Prop>& props);

/// "person 'anna', action 2 (sit)": how messages begin.
[[nodiscard]] std::string action_label(const PersonDescription& person, std::size_t action);

}  // namespace tsg::simulation
