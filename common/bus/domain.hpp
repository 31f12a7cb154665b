#pragma once

#include <memory>
#include <string>

#include "common/bus/bus_config.hpp"
#include "common/bus/dds_entity.hpp"
#include "common/bus/qos.hpp"

namespace tsg {

/// What a participant of the shared-memory domain tells the others in its user data
/// (discovery.hpp).
inline constexpr const char* kSaysSharedMemory = "tsg transport=shared_memory";
inline constexpr const char* kSaysUdp = "tsg transport=udp";

/// Number of the DDS domain that `domain` has in `config`.
[[nodiscard]] int domain_id(const BusConfig& config, Domain domain);

/// The Cyclone DDS configuration of that domain. CYCLONEDDS_URI is not read: services take their
/// configuration from one place, and a stray variable must not switch shared memory off.
[[nodiscard]] std::string domain_xml(const BusConfig& config, Domain domain);

/// The domain, which Cyclone keeps once a process: shared by every Bus of the process, gone with
/// the last one. Throws FatalError (kConfig) where it exists with another configuration.
[[nodiscard]] std::shared_ptr<const DdsEntity> join_domain(const BusConfig& config, Domain domain);

}  // namespace tsg
