#include "common/bus/discovery.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "common/bus/domain.hpp"

namespace tsg {
namespace {

using Key = std::array<std::uint8_t, sizeof(dds_guid_t)>;
using Peers = std::map<Key, Peer>;
using Topics = std::map<std::tuple<Domain, std::string, std::string>, TopicInfo>;
using DdsString = std::unique_ptr<char, decltype(&dds_free)>;

Key key_of(const dds_guid_t& guid) {
  Key key{};
  std::copy(std::begin(guid.v), std::end(guid.v), key.begin());
  return key;
}

std::string property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos, name, &value)) return "";
  return DdsString(value, &dds_free).get();
}

std::string user_data(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return "";
  const DdsString owned(static_cast<char*>(data), &dds_free);
  return {owned.get(), size};
}

/// Hands every living sample of a built-in topic to `handle`.
template <typename Builtin, typename Handle>
void for_each(std::int32_t participant, dds_entity_t builtin_topic, Handle handle) {
  const DdsEntity reader(dds_create_reader(participant, builtin_topic, nullptr, nullptr),
                         "a reader of a built-in topic");
  for (;;) {
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader.handle(), &sample, &info, 1, 1) != 1) return;
    if (info.valid_data && info.instance_state == DDS_ALIVE_INSTANCE_STATE) {
      handle(*static_cast<const Builtin*>(sample));
    }
    dds_return_loan(reader.handle(), &sample, 1);
  }
}

Peer describe_participant(const dds_builtintopic_participant_t& participant, Domain domain) {
  Peer peer;
  peer.host = property(participant.qos, "__Hostname");
  peer.process = property(participant.qos, "__ProcessName");
  peer.pid = std::atoi(property(participant.qos, "__Pid").c_str());  // NOLINT: 0 is "not told"
  if (domain == Domain::kSharedMemory) {
    const std::string said = user_data(participant.qos);
    peer.transport = said == kSaysSharedMemory ? Transport::kSharedMemory
                     : said == kSaysUdp        ? Transport::kUdp
                                               : Transport::kUnknown;
  }
  return peer;
}

class DomainListing {
 public:
  DomainListing(Bus& bus, Domain domain, Topics& topics)
      : domain_(domain),
        domain_id_(domain_id(bus.context().config(), domain)),
        participant_(bus.context().participant(domain)),
        topics_(&topics) {
    dds_guid_t guid{};
    dds_get_guid(participant_, &guid);
    own_ = key_of(guid);
  }

  void add_all() {
    for_each<dds_builtintopic_participant_t>(
        participant_, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, [this](const auto& participant) {
          peers_[key_of(participant.key)] = describe_participant(participant, domain_);
        });
    add_endpoints(DDS_BUILTIN_TOPIC_DCPSPUBLICATION, &TopicInfo::writers);
    add_endpoints(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, &TopicInfo::readers);
  }

 private:
  void add_endpoints(dds_entity_t builtin_topic, std::vector<Peer> TopicInfo::*side) {
    for_each<dds_builtintopic_endpoint_t>(
        participant_, builtin_topic, [&](const dds_builtintopic_endpoint_t& endpoint) {
          const Key participant = key_of(endpoint.participant_key);
          if (participant == own_) return;
          TopicInfo& topic = (*topics_)[{domain_, endpoint.topic_name, endpoint.type_name}];
          topic.name = endpoint.topic_name;
          topic.type = endpoint.type_name;
          topic.domain = domain_;
          topic.domain_id = domain_id_;
          Peer peer = peers_[participant];
          if (!is_eligible(endpoint.qos) && peer.transport == Transport::kSharedMemory) {
            peer.transport = Transport::kUdp;
          }
          (topic.*side).push_back(peer);
        });
  }

  /// What Cyclone asks of an endpoint before it uses shared memory, as far as QoS shows.
  static bool is_eligible(const dds_qos_t* qos) {
    dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
    dds_qget_durability(qos, &durability);
    return durability == DDS_DURABILITY_VOLATILE;
  }

  Domain domain_;
  int domain_id_;
  std::int32_t participant_;
  Key own_{};
  Peers peers_;
  Topics* topics_;
};

}  // namespace

std::vector<TopicInfo> discover_topics(Bus& bus,
                                       std::chrono::milliseconds wait,
                                       const std::stop_token& stop) {
  Waiter waiter(bus.context().participant(Domain::kStandard), 0);
  waiter.wait_until(Waiter::deadline_after(wait), stop);
  Topics found;
  for (const Domain domain : {Domain::kStandard, Domain::kSharedMemory}) {
    DomainListing(bus, domain, found).add_all();
  }
  std::vector<TopicInfo> topics;
  for (auto& [key, topic] : found) topics.push_back(std::move(topic));
  std::sort(topics.begin(), topics.end(),
            [](const TopicInfo& a, const TopicInfo& b) { return a.name < b.name; });
  return topics;
}

}  // namespace tsg
