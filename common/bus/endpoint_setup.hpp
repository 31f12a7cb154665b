#pragma once

#include <string>

#include "common/bus/endpoint.hpp"

namespace tsg {

/// The DDS topic of `spec` in its domain.
[[nodiscard]] DdsEntity create_topic(BusContext& context, const TopicSpec& spec);

/// A writer or reader of `topic` with the QoS of `spec`.
[[nodiscard]] DdsEntity create_writer(BusContext& context,
                                      const TopicSpec& spec,
                                      const DdsEntity& topic);
[[nodiscard]] DdsEntity create_reader(BusContext& context,
                                      const TopicSpec& spec,
                                      const DdsEntity& topic);

/// Whether DDS gave the endpoint shared memory; says so on stderr, loudly, where a topic of the
/// shared-memory domain has none, since DDS itself falls back to copies without a word.
[[nodiscard]] bool check_shared_memory(const BusContext& context,
                                       const TopicSpec& spec,
                                       const DdsEntity& endpoint,
                                       const char* endpoint_kind);

}  // namespace tsg
