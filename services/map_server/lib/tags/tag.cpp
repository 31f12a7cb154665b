#include "services/map_server/lib/tags/tag.hpp"

namespace tsg {

std::string_view name_of(TagState state) {
  switch (state) {
    case TagState::kStatic:
      return "static";
    case TagState::kMoved:
      return "moved";
    case TagState::kGone:
      return "gone";
  }
  return "unknown";
}

}  // namespace tsg
