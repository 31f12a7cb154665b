#include "services/tsgctl/topic_list.hpp"

namespace tsg {

std::vector<std::string> topic_names() {
  std::vector<std::string> names;
  detail::for_each_topic([&names]<typename Topic>() { names.emplace_back(Topic::kName); });
  return names;
}

void throw_unknown_topic(const std::string& name) {
  std::string message = "there is no topic \"" + name + "\"; there are";
  for (const std::string& known : topic_names()) message += "\n  " + known;
  throw FatalError(ExitCode::kUsage, message);
}

}  // namespace tsg
