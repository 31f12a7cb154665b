#include "common/bus/endpoint_setup.hpp"

#include <dds/dds.h>
#include <dds/ddsc/dds_loan_api.h>

#include <cstdio>
#include <memory>

namespace tsg {
namespace {

using QosPointer = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

QosPointer make_qos(const Qos& wanted) {
  QosPointer qos(dds_create_qos(), &dds_delete_qos);
  // A reader that is gone but not yet missed may hold a writer up for so long, no longer.
  constexpr dds_duration_t kMaxBlocking = DDS_MSECS(100);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kMaxBlocking);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, wanted.keep_last);
  if (wanted.durability == Durability::kTransientLocal) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  } else {
    dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  }
  // ROS 2 nodes of the same age speak nothing else.
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &representation);
  return qos;
}

std::string describe(const char* kind, const TopicSpec& spec) {
  return std::string("the ") + kind + " of topic '" + spec.name + "'";
}

}  // namespace

DdsEntity create_topic(BusContext& context, const TopicSpec& spec) {
  const std::int32_t participant = context.participant(spec.qos.domain);
  return {dds_create_topic(participant, spec.descriptor, spec.name, nullptr, nullptr),
          std::string("topic '") + spec.name + "'"};
}

DdsEntity create_writer(BusContext& context, const TopicSpec& spec, const DdsEntity& topic) {
  const std::int32_t participant = context.participant(spec.qos.domain);
  const QosPointer qos = make_qos(spec.qos);
  return {dds_create_writer(participant, topic.handle(), qos.get(), nullptr),
          describe("writer", spec)};
}

DdsEntity create_reader(BusContext& context, const TopicSpec& spec, const DdsEntity& topic) {
  const std::int32_t participant = context.participant(spec.qos.domain);
  const QosPointer qos = make_qos(spec.qos);
  return {dds_create_reader(participant, topic.handle(), qos.get(), nullptr),
          describe("reader", spec)};
}

bool check_shared_memory(const BusContext& context,
                         const TopicSpec& spec,
                         const DdsEntity& endpoint,
                         const char* endpoint_kind) {
  if (spec.qos.domain != Domain::kSharedMemory) return false;
  if (dds_is_loan_available(endpoint.handle())) return true;
  const char* why = context.config().use_shared_memory
                        ? "its type or QoS is not eligible (docs/bus.md, zero copy)"
                        : "bus.use_shared_memory is false";
  std::fprintf(stderr,
               "WARNING: bus: %s is NOT ON SHARED MEMORY: %s. Every sample is copied and sent "
               "over UDP.\n",
               describe(endpoint_kind, spec).c_str(), why);
  return false;
}

}  // namespace tsg
