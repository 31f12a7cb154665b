#include "common/bus/dds_entity.hpp"

#include <dds/dds.h>

namespace tsg {

DdsEntity::DdsEntity(std::int32_t created, const std::string& what) : handle_(created) {
  if (created < 0) throw FatalError(dds_error("cannot create " + what, created));
}

DdsEntity::~DdsEntity() {
  if (handle_ > 0) dds_delete(handle_);
}

Error dds_error(const std::string& what, std::int32_t return_code) {
  return Error{ExitCode::kUnavailable, what + ": DDS says '" + dds_strretcode(-return_code) + "'"};
}

}  // namespace tsg
