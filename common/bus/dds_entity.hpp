#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "common/core/error.hpp"

namespace tsg {

/// Owns one DDS entity (participant, topic, writer, ...); move-only.
class DdsEntity {
 public:
  DdsEntity() = default;
  /// Takes what a dds_create_*() returned. Throws FatalError naming `what` where that is an error.
  DdsEntity(std::int32_t created, const std::string& what);
  ~DdsEntity();
  DdsEntity(DdsEntity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  DdsEntity& operator=(DdsEntity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  DdsEntity(const DdsEntity&) = delete;
  DdsEntity& operator=(const DdsEntity&) = delete;

  [[nodiscard]] std::int32_t handle() const { return handle_; }

 private:
  std::int32_t handle_ = 0;
};

/// "what: reason" for a negative DDS return code.
[[nodiscard]] Error dds_error(const std::string& what, std::int32_t return_code);

}  // namespace tsg
